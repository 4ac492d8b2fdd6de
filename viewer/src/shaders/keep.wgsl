// Keeps what the pixel `id` of the tile sees: the sky.
fn keep(id: vec2<u32>, sky: vec4<f32>) {
    store(id, sky);
}
