// Light without its frequency shift.
fn seen_light(light: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    return light;
}
