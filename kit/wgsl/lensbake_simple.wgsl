// The bending of light by a black hole that does not rotate, for all observers at rest.
//
// lensbake_simple(d, hole, r, atlas, linear_clamp) returns the direction on the sky from which the light comes
// that is seen in the direction d, or (0, 0, 0) if the ray ends in the hole: draw it black.
//   d             unit view direction, in any frame
//   hole          unit direction of the hole, in the same frame, for example (0, 0, -1)
//   r             radius of the observer in Schwarzschild radii, above 1; 1e30 for infinity
//   atlas         texture of 64 x 128 texels, R the value (floats), the first row at v = 0, which is the top line
//                 of the file: linear data (no sRGB), no mipmaps, no compression, linear filter, clamped to the
//                 edge
//   linear_clamp  its sampler
// lensbake_simple_bend returns the bending (deflection angle) in radians. Compute in 32-bit floats: with 16 bits
// (mediump, half) the picture is off by up to 3 pixels and grainy.
//
// Error of the numbers (f16, 64 texels a row) against the closed form: 4.3e-4 rad on the sky, 0.121 pixels of a
// picture 1920 pixels wide and 90 degrees across. These are the largest of 20000 random rays in 64-bit arithmetic;
// 32-bit arithmetic adds up to 5e-4 pixels.
//
// Made by: bake export --to wgsl --mode simple --texels 64 --precision f16 --function lensbake_simple
// Part of lensbake. Licence: MIT or Apache-2.0, as you like.

// The edge of the shadow (critical curve), as an observer sees it at the angle theta_c from the direction of the hole.
struct lensbake_simple_ShadowEdge {
    // tan(theta_c/2).
    tan_half: f32,
    // (5/18) cos(theta_c).
    log_weight: f32,
}

// The edge of the shadow that the observer at rest at r > 1 sees. It depends on r alone, not on the pixel.
fn lensbake_simple_shadow_edge(r: f32) -> lensbake_simple_ShadowEdge {
    let u: f32 = 1.0 / r;
    let cosine: f32 = 2.598076211 * (0.6666666667 - u) * sqrt(0.3333333333 + u);
    let sine: f32 = 2.598076211 * u * sqrt(max((r - 1.0) / r, 0.0));
    var edge: lensbake_simple_ShadowEdge;
    edge.tan_half = select((1.0 - cosine) / max(sine, 1e-30), sine / (1.0 + cosine), cosine >= 0.0);
    edge.log_weight = 0.2777777778 * cosine;
    return edge;
}

// The row coordinate above the horizon: the normalised shadow coordinate x = tan(θ_c/2) / tan(θ/2) of the direction
// (cos θ, sin θ) = (c, p)/√(c² + p²), where p ≥ 0; the vector (c, p) need not be normalised. Very large at θ = 0.
fn lensbake_simple_row_coordinate(c: f32, p: f32, edge: lensbake_simple_ShadowEdge) -> f32 {
    let size: f32 = sqrt(c * c + p * p);
    // cot(θ/2), without the cancellation of size − |c|.
    let adjacent: f32 = select(p, size + c, c >= 0.0);
    let opposite: f32 = select(size - c, max(p, 1e-30), c >= 0.0);
    return edge.tan_half * (adjacent / opposite);
}

// The position along the row, from d = 1 − x and √x.
fn lensbake_simple_row_position(d: f32, root: f32) -> f32 {
    return sqrt(d / (1.0 + root));
}

// The stored value at the position q, from 0 at the edge of the shadow to 1 straight away from the hole, for the
// observer at rest at r: one fetch from the atlas with linear filtering. The centres of texels are at half-integers.
fn lensbake_simple_stored_value(q: f32, r: f32, atlas: texture_2d<f32>, linear_clamp: sampler) -> f32 {
    let row: f32 = 127.0 * 0.6366197724 * atan(1.0 / sqrt(max(r - 1.0, 1e-30)));
    let x: f32 = (q * 63.0 + 0.5) / 64.0;
    let y: f32 = (row + 0.5) / 128.0;
    return textureSampleLevel(atlas, linear_clamp, vec2<f32>(x, y), 0.0).x;
}

// The bending (deflection angle) in rad of the light that is seen at the angle theta from the direction of the hole,
// with cos(theta) = c and sin(theta) = p. It comes from the angle theta - bend. 1e4 if the ray ends in the hole.
fn lensbake_simple_bend(c: f32, p: f32, edge: lensbake_simple_ShadowEdge, r: f32, atlas: texture_2d<f32>, linear_clamp: sampler) -> f32 {
    let x: f32 = lensbake_simple_row_coordinate(c, p, edge);
    if (x >= 1.0) {
        return 1e4;
    }
    let d: f32 = 1.0 - x;
    let stored: f32 = lensbake_simple_stored_value(lensbake_simple_row_position(d, sqrt(x)), r, atlas, linear_clamp);
    return stored - (1.0 + edge.log_weight * d) * log(d);
}

// (cos, sin) of an angle in rad, to 1e-7 up to 100 turns. The built-in pair need only be good to
// 5e-4 on a Vulkan device, which is half a pixel.
fn lensbake_simple_cos_sin(angle: f32) -> vec2<f32> {
    let quarter: f32 = round(angle * 0.63661975);
    // π/2 in three parts, the products of the first two exact: a device need not fuse an fma.
    let r: f32 = ((angle - quarter * 1.5703125) - quarter * 4.837513e-4) - quarter * 7.54979e-8;
    let r2: f32 = r * r;
    let sine: f32 = r + r * r2 * (-1.6666654e-1 + r2 * (8.332161e-3 + r2 * -1.9515296e-4));
    let cosine: f32 = 1.0 - 0.5 * r2 + r2 * r2 * (4.1666646e-2 + r2 * (-1.3887316e-3 + r2 * 2.4433157e-5));
    let turn: i32 = i32(quarter) & 3;
    let swapped: vec2<f32> = select(vec2<f32>(cosine, sine), vec2<f32>(sine, cosine), (turn & 1) == 1);
    return vec2<f32>(
        select(swapped.x, -swapped.x, turn == 1 || turn == 2),
        select(swapped.y, -swapped.y, turn >= 2)
    );
}

// (cos θ′, sin θ′) of the direction turned towards the hole by the bending Δ: θ′ = θ − Δ. It has the length of (c, p).
fn lensbake_simple_turned(c: f32, p: f32, bend: f32) -> vec2<f32> {
    let t: vec2<f32> = lensbake_simple_cos_sin(bend);
    return vec2<f32>(c * t.x + p * t.y, p * t.x - c * t.y);
}

// The direction on the sky from which the light comes that is seen in the direction d; hole is the direction of the hole.
// All are unit vectors in any one frame. (0, 0, 0) if the ray ends in the hole.
fn lensbake_simple(d: vec3<f32>, hole: vec3<f32>, r: f32, atlas: texture_2d<f32>, linear_clamp: sampler) -> vec3<f32> {
    // (x, y, z) is the part of d across the direction of the hole, found from the difference of the two directions, which
    // is exact where they are close: the shadow of a distant hole is small.
    let side: f32 = select(-1.0, 1.0, d.x * hole.x + d.y * hole.y + d.z * hole.z >= 0.0);
    let off_x: f32 = d.x - side * hole.x;
    let off_y: f32 = d.y - side * hole.y;
    let off_z: f32 = d.z - side * hole.z;
    let along: f32 = off_x * hole.x + off_y * hole.y + off_z * hole.z;
    let x: f32 = off_x - along * hole.x;
    let y: f32 = off_y - along * hole.y;
    let z: f32 = off_z - along * hole.z;
    let p: f32 = sqrt(x * x + y * y + z * z);
    let c: f32 = side + along;
    let angle: f32 = lensbake_simple_bend(c, p, lensbake_simple_shadow_edge(r), r, atlas, linear_clamp);
    if (angle > 1e3) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    let sky: vec2<f32> = lensbake_simple_turned(c, p, angle);
    let across: f32 = sky.y / max(p, 1e-30);
    return vec3<f32>(
        sky.x * hole.x + across * x,
        sky.x * hole.y + across * y,
        sky.x * hole.z + across * z
    );
}
