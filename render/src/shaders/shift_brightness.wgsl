// Light with the brightness of its frequency shift g: the total intensity grows as g⁴. shift.rs is the reference in f64.
// #import frequency_shift

// The light that the camera sees, from the light of the sky and the unit direction d in which the observer of the row
// sees it.
fn seen_light(light: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let g = frequency_shift(d);
    return light * (g * g * g * g * camera.light_scale);
}
