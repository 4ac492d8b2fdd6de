// The lookup of the direction on the sky in a row of stereographic coordinates, on a GPU. Its mirror in Rust is
// stereographic/mod.rs, which explains it. Needs the module `row`: the constants INTERVALS, FRACTION and FIRST and
// `fn row_texel(i: u32) -> vec4<f32>`; and one of the modules `row_coordinate_above` (above the horizon) and
// `row_coordinate_below`, named `row_coordinate`.
// #import row
// #import row_coordinate
// #import shadow_edge

struct SkyDirection {
    captured: bool,
    // (cos θ′, sin θ′) up to a factor.
    cos_sin: vec2<f32>,
    // dθ′/dθ, the derivative along the view angle.
    radial: f32,
}

// The direction on the sky in which light comes that is seen in the direction (cos θ, sin θ) = (c, p): tan(θ′/2) = B/A with
// A and B linear in an interval of X or of 1 − X. For the direction alone the vector (c, p) need not be normalised; the
// derivative needs a unit vector.
fn sky_direction(c: f32, from_axis: f32, edge: ShadowEdge) -> SkyDirection {
    // Straight away from the hole, x/sin θ has a limit.
    let p = max(from_axis, 1e-30);
    let x = row_coordinate(c, p, edge);
    if x >= 1.0 {
        return SkyDirection(true, vec2(0.0), 0.0);
    }
    let d = 1.0 - x;
    let beside_edge = x > d;
    let v = min(x, d);
    // The exponent of v and the first bits of its mantissa. The first interval begins at 0.
    let bits = clamp(bitcast<u32>(v) >> FRACTION, FIRST, FIRST + INTERVALS - 1u);
    let i = bits - FIRST;
    let start = select(bitcast<f32>(bits << FRACTION), 0.0, i == 0u);
    let texel = row_texel(i + select(0u, INTERVALS, beside_edge));
    let t = v - start;
    let a = texel.x + t * texel.z;
    let b = texel.y + t * texel.w;
    let by_v = 2.0 * (a * texel.w - b * texel.z) / (a * a + b * b);
    let by_x = select(by_v, -by_v, beside_edge);
    return SkyDirection(false, vec2((a - b) * (a + b), 2.0 * a * b), by_view_angle(by_x, x, p, edge));
}
