// The inverse of the lens: maps sky angles to images. gpu/stars/data.rs has the same struct.
// #import inverse
// #import inverse_constants
struct InverseLens {
    // Distance from the optical axis up to which a star is drawn as arcs only, rad.
    point_distance: f32,
    candidates: u32,
    pieces: u32,
    @align(16) inverse: Inverse,
    // Texels of the inverse row, two in each vector.
    @align(16) texels: array<vec4<f32>, INVERSE_PAIRS>,
}

@group(0) @binding(3) var<uniform> lens: InverseLens;

struct StarImage {
    visible: bool,
    // (cos θ, sin θ).
    cos_sin: vec2<f32>,
    magnification: f32,
}

fn inverse_texel(i: u32) -> vec2<f32> {
    let pair = lens.texels[i / 2u];
    return select(pair.xy, pair.zw, (i & 1u) == 1u);
}
