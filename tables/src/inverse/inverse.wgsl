// The inverse row on a GPU. Each function has its twin of the same name in gpu.rs.
// Needs beside it `const INVERSE_LAST: u32`, the index of the inverse row's last texel,
// `fn inverse_texel(i: u32) -> vec2<f32>`, which loads one, and the arithmetic of the lookup.

// What the texels are measured from and along.
struct Inverse {
    // θ_c, rad.
    edge: f32,
    // ϑ = scale sinh v, rad.
    scale: f32,
    // ϑ and v of the first texel.
    first_angle: f32,
    first: f32,
    texels_per_v: f32,
}

struct Image {
    // (cos θ, sin θ) of the direction in which it is seen.
    cos_sin: vec2<f32>,
    // dθ/dϑ.
    stretch: f32,
}

// e^v of x = sinh v, to a few parts in 1e7.
fn exp_arsinh(x: f32) -> f32 {
    let size = abs(x);
    let grown = size + sqrt(size * size + 1.0);
    return select(grown, 1.0 / grown, x < 0.0);
}

// Where the light that comes from the unwrapped sky angle ϑ ≤ π (rad) is seen.
fn image(sky_angle: f32, inverse: Inverse) -> Image {
    // Beyond the first texel the light turns further, and ln(θ − θ_c) falls by as much.
    let inside = max(sky_angle, inverse.first_angle);
    let u = inside / inverse.scale;
    let exp_v = exp_arsinh(u);
    let position = clamp((log(exp_v) - inverse.first) * inverse.texels_per_v, 0.0, f32(INVERSE_LAST));
    let i = min(u32(position), INVERSE_LAST - 1u);
    let stored = cubic(inverse_texel(i), inverse_texel(i + 1u), position - f32(i));
    let offset = 0.5 * inverse.scale * exp_v * exp(stored.x + (sky_angle - inside));
    let slope = 1.0 + stored.y * inverse.texels_per_v;
    return Image(cos_sin(inverse.edge + offset), offset * slope / (inverse.scale * sqrt(u * u + 1.0)));
}

// How many times brighter than without the hole a point with p = |sin ϑ| is seen at the image of ϑ:
// μ = sin θ dθ / (|sin ϑ| dϑ).
fn magnification(seen: Image, sky_angle: f32, p: f32) -> f32 {
    // Straight away both sines vanish; their ratio is dθ/dϑ to (π − ϑ)².
    let straight_away = sky_angle > 3.13;
    return seen.stretch * select(max(seen.cos_sin.y, 0.0) / max(p, 1e-30), seen.stretch, straight_away);
}
