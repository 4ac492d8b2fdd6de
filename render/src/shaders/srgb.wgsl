// Encoding for the screen. picture.rs has the mirror.

// The sRGB transfer function (IEC 61966-2-1).
fn srgb_from_linear(linear: vec3<f32>) -> vec3<f32> {
    let clamped = clamp(linear, vec3(0.0), vec3(1.0));
    let curved = 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055;
    return select(curved, 12.92 * clamped, clamped <= vec3(0.0031308));
}
