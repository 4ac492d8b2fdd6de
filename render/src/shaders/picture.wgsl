// The picture, one ray per pixel.
// #import keep
// #import ray_light
// #import view

// The light of pixel `id` of the region.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    return kept(id, ray_light(view_vector(id)));
}
