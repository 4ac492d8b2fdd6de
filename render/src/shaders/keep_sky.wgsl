// Stores pixel `id` of the region: the sky alone.
// #import output
fn keep(id: vec2<u32>, sky: vec4<f32>) {
    store(id, sky);
}
