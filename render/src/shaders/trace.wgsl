// The trace: where the light of each pixel comes from, as a direction on the sky in the hole frame, and the ray
// outcome.
// #import deflect
// #import view

// The direction and the outcome of pixel `id` of the region.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let d = view_direction(id);
    let p = length(d.xy);
    let deflected = deflect(-d.z, p);
    let direction = turn_direction(d, p, deflected);
    return vec4(direction / max(length(direction), 1e-30), f32(deflected.outcome));
}
