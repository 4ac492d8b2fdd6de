// The lookup in an inverse row, on a GPU. Its mirror in Rust is inverse/gpu.rs. Needs `const INVERSE_LAST: u32`,
// the index of the inverse row's last texel, and `fn inverse_texel(i: u32) -> vec2<f32>`, which loads a texel.
// #import arithmetic

// Parameters of an inverse row: the view angle that its values are relative to, and its axis.
struct Inverse {
    // θ_c, rad.
    edge: f32,
    // Centre and scale of the axis in ϑ = centre + scale sinh v, rad.
    centre: f32,
    scale: f32,
    // ϑ and v of the first texel.
    first_angle: f32,
    first: f32,
    texels_per_v: f32,
}

struct Image {
    // (cos θ, sin θ) of the direction in which the image is seen.
    cos_sin: vec2<f32>,
    // Radial magnification dθ/dϑ.
    radial_magnification: f32,
}

// e^v as a function of x = sinh v, to a few parts in 1e7.
fn exp_arsinh(x: f32) -> f32 {
    let size = abs(x);
    let grown = size + sqrt(size * size + 1.0);
    return select(grown, 1.0 / grown, x < 0.0);
}

// The image for the unwrapped sky angle ϑ ≤ π (rad): the direction in which light from there is seen.
fn image(sky_angle: f32, inverse: Inverse) -> Image {
    // Below the first texel's ϑ, ln(θ − θ_c) is linear in ϑ with slope 1.
    let inside = max(sky_angle, inverse.first_angle);
    let u = (inside - inverse.centre) / inverse.scale;
    let exp_v = exp_arsinh(u);
    let position = clamp((log(exp_v) - inverse.first) * inverse.texels_per_v, 0.0, f32(INVERSE_LAST));
    let i = min(u32(position), INVERSE_LAST - 1u);
    let stored = cubic(inverse_texel(i), inverse_texel(i + 1u), position - f32(i));
    let offset = 0.5 * inverse.scale * exp_v * exp(stored.x + (sky_angle - inside));
    let slope = 1.0 + stored.y * inverse.texels_per_v;
    return Image(cos_sin(inverse.edge + offset), offset * slope / (inverse.scale * sqrt(u * u + 1.0)));
}

// Magnification of a point source with p = |sin ϑ| at the image for ϑ, the ratio of its brightness to that without
// the hole: μ = sin θ dθ / (|sin ϑ| dϑ).
fn magnification(seen: Image, sky_angle: f32, p: f32) -> f32 {
    // Straight away from the hole both sines vanish; their ratio is dθ/dϑ up to terms of order (π − ϑ)².
    let straight_away = sky_angle > 3.13;
    return seen.radial_magnification * select(max(seen.cos_sin.y, 0.0) / max(p, 1e-30), seen.radial_magnification, straight_away);
}
