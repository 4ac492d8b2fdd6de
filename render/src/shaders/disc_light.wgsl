// The light of the disc. disc/light.rs is the reference in f64.
// #import constants
// #import disc
// #import disc_hits
// #import disc_pattern
// #import frequency_shift

// Page and Thorne's flux without its factor, x = 2r.
fn disc_flux(r: f32) -> f32 {
    let x = 2.0 * r;
    let root = sqrt(x);
    let inner = (root + 1.7320508) * 0.17157288 / (root - 1.7320508);
    let bracket = root - 2.4494898 + 0.8660254 * log(inner);
    return max(bracket, 0.0) / ((x - 3.0) * x * x * root);
}

// The light of a black body with this reciprocal of its temperature, of luminance 1.
fn black_body(inverse_kelvin: f32) -> vec3<f32> {
    let change = clamp(inverse_kelvin, HOTTEST, COLDEST) - WHITE_BODY;
    let light = vec3(1.0, exp(-GREEN_OVER_RED * change), exp(-BLUE_OVER_RED * change));
    return light / dot(light, vec3(0.2126, 0.7152, 0.0722));
}

// ν_em/ν_∞ of matter at radius r that emits light with this angular momentum about the axis.
fn emitted_frequency(r: f32, momentum: f32) -> f32 {
    let slow = 2.0 * r - 3.0;
    return sqrt(2.0 * r / slow) - momentum / (r * sqrt(slow));
}

// The light of the disc where a leg of the rays of a patch crosses it.
fn disc_light(seen: Patch, orbit: Orbit, crossing: Crossing) -> vec3<f32> {
    let reached = orbit_inverse_radius(sqrt(orbit.inv_b_sq.value), crossing.phase);
    let u = clamp(reached, disc.outer_u, disc.inner_u);
    let r = 1.0 / u;
    let momentum = (seen.d.y * disc.axis.x - seen.d.x * disc.axis.y) * orbit.by_sine;
    let g = frequency_shift(seen.d) / emitted_frequency(r, momentum);
    let flux = disc_flux(r);
    let brightening = select(1.0, g * g * g * g, disc.shifts_brightness > 0.0);
    let seen_kelvin = select(1.0, g, disc.shifts_colour > 0.0);
    let relative = max(disc.relative * flux, 1e-20);
    let inverse = disc.inverse_kelvin / (seen_kelvin * sqrt(sqrt(relative)));
    return black_body(inverse) * (disc.luminance * flux * brightening * disc_pattern(seen, orbit, crossing, u));
}
