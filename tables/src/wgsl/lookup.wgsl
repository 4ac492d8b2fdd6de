// The lookup of the bending Δ (deflection angle) in a row, on a GPU. Its mirror in Rust is mirror.rs. Needs the
// module `row`: `const ROW_LAST: u32`, the index of the row's last texel, `fn row_texel(i: u32) -> vec2<f32>`,
// which loads a texel, and `fn interpolate(position: f32) -> vec2<f32>`, which is `linear` or `hermite`. Needs one of
// the modules `row_coordinate_above` (above the horizon) and `row_coordinate_below`, named `row_coordinate`.
// #import arithmetic
// #import row
// #import row_coordinate
// #import shadow_edge

// Bound on sin θ and X. If both are below it and cos θ < 0, the ray looks straight away from the hole and Δ is
// away_slope·X, with a relative error of 1e-6.
const STRAIGHT_AWAY: f32 = 1e-3;

struct Bending {
    captured: bool,
    // Δ, the deflection angle, rad.
    bend: f32,
    // dΔ/dθ, the derivative along the view angle.
    slope: f32,
}

// Linear interpolation at `position` (in texels): the value and its derivative per texel. Uses the values only.
fn linear(position: f32) -> vec2<f32> {
    let i = min(u32(position), ROW_LAST - 1u);
    return chord(row_texel(i), row_texel(i + 1u), position - f32(i));
}

// Cubic Hermite interpolation at `position` (in texels): the value and its derivative per texel.
fn hermite(position: f32) -> vec2<f32> {
    let i = min(u32(position), ROW_LAST - 1u);
    return cubic(row_texel(i), row_texel(i + 1u), position - f32(i));
}

// The bending in the direction (cos θ, sin θ) = (c, p), from a row on the residual axis:
// Δ = R(q) − (1 + weight·d) ln d with X the row coordinate, d = 1 − X, and q the position. The slope is inaccurate straight away from the
// hole: use `bending_for_footprint` there. For Δ alone the vector (c, p) need not be normalised; the slope needs a unit vector.
fn bending(c: f32, p: f32, edge: ShadowEdge) -> Bending {
    let x = row_coordinate(c, p, edge);
    if x >= 1.0 {
        return Bending(true, 0.0, 0.0);
    }
    let d = 1.0 - x;
    let root = sqrt(x);
    let q = row_position(d, root);
    let r = interpolate(q * f32(ROW_LAST));
    let ln = log(d);
    let factor = 1.0 + edge.log_weight * d;
    // dΔ/dθ = dΔ/dX dX/dθ, with dΔ/dX by the chain rule.
    let dx_dq = row_position_slope(q, root);
    let by_x = r.y * f32(ROW_LAST) / dx_dq + edge.log_weight * ln + factor / d;
    return Bending(false, r.x - factor * ln, by_view_angle(by_x, x, p, edge));
}

// `bending`, replaced by its limit straight away from the hole. There the terms of the residual cancel, and the
// size of a footprint is a quotient of the small remainders.
fn bending_for_footprint(c: f32, p: f32, edge: ShadowEdge) -> Bending {
    let x = row_coordinate(c, p, edge);
    if c < 0.0 && max(p, x) < STRAIGHT_AWAY {
        // dX/dθ → −X/sin θ, with X/sin θ → tan(θ_c/2)/(σ (1 − cos θ)).
        return Bending(false, edge.away_slope * x, -edge.away_slope * edge.tan_half / (1.0 - c));
    }
    return bending(c, p, edge);
}

// (cos θ′, sin θ′) of the direction turned towards the hole by the bending Δ: θ′ = θ − Δ. It has the length of (c, p).
fn turned(c: f32, p: f32, bend: f32) -> vec2<f32> {
    let t: vec2<f32> = cos_sin(bend);
    return vec2<f32>(c * t.x + p * t.y, p * t.x - c * t.y);
}
