// The lookup on a GPU. Each function has its twin of the same name in lookup.rs.
// Needs beside it: `const ROW_LAST: u32`, the index of the row's last texel,
// `fn row_texel(i: u32) -> vec2<f32>`, which loads one, and `fn interpolate(position: f32) -> vec2<f32>`,
// which is one of the two below.

// The shadow's edge as the observer sees it.
struct Edge {
    // tan(θ_c/2).
    tan_half: f32,
    // (5/18) cos θ_c, the weight of (1−x) ln(1−x) beside ln(1−x).
    log_weight: f32,
    // dΔ/dx at x = 0, straight away from the hole.
    away_slope: f32,
}

// sin θ and x below which a ray looks straight away from the hole: Δ is away_slope·x, to 1e-6 of itself.
const STRAIGHT_AWAY: f32 = 1e-3;

struct Bending {
    captured: bool,
    // Δ, rad.
    bend: f32,
    // dΔ/dθ along the view angle.
    slope: f32,
}

// x = tan(θ_c/2) / tan(θ/2) of a unit direction with cos θ = c ≥ −1 and sin θ = p ≥ 0.
// Infinite straight at the hole.
fn edge_coordinate(c: f32, p: f32, edge: Edge) -> f32 {
    let cot_half = select(p / (1.0 - c), (1.0 + c) / max(p, 1e-30), c >= 0.0);
    return edge.tan_half * cot_half;
}

// Linear at `position` in texels: the value and its derivative a texel. Reads the values only.
fn linear(position: f32) -> vec2<f32> {
    let i = min(u32(position), ROW_LAST - 1u);
    let a = row_texel(i).x;
    let rise = row_texel(i + 1u).x - a;
    return vec2(a + (position - f32(i)) * rise, rise);
}

// Cubic Hermite at `position` in texels: the value and its derivative a texel.
fn hermite(position: f32) -> vec2<f32> {
    let i = min(u32(position), ROW_LAST - 1u);
    return cubic(row_texel(i), row_texel(i + 1u), position - f32(i));
}

// The bending of a row on the residual axis, Δ = R(q) − (1 + weight·d) ln d with d = 1 − x and
// q = √(1−√x).
fn bending(c: f32, p: f32, edge: Edge) -> Bending {
    let x = edge_coordinate(c, p, edge);
    if x >= 1.0 {
        return Bending(true, 0.0, 0.0);
    }
    // There the terms of the residual cancel, and the size of a footprint is a quotient of what is left.
    if c < 0.0 && max(p, x) < STRAIGHT_AWAY {
        // dx/dθ = −x/sin θ, with x/sin θ = tan(θ_c/2)/(1 − cos θ).
        let slope = -edge.away_slope * edge.tan_half / (1.0 - c);
        return Bending(false, edge.away_slope * x, slope);
    }
    let d = 1.0 - x;
    let root = sqrt(x);
    let q = sqrt(d / (1.0 + root));
    let r = interpolate(q * f32(ROW_LAST));
    let ln = log(d);
    let factor = 1.0 + edge.log_weight * d;
    // dΔ/dθ = dΔ/dx dx/dθ with dx/dq = −4 q √x and dx/dθ = −x/sin θ.
    let dx_dq = -4.0 * q * max(root, 1e-9);
    let by_x = r.y * f32(ROW_LAST) / dx_dq + edge.log_weight * ln + factor / d;
    return Bending(false, r.x - factor * ln, -by_x * x / max(p, 1e-30));
}

// (cos θ′, sin θ′) of the direction turned towards the hole, θ′ = θ − Δ.
fn turned(c: f32, p: f32, bend: f32) -> vec2<f32> {
    let t = cos_sin(bend);
    return vec2(c * t.x + p * t.y, p * t.x - c * t.y);
}
