// Keeps what the pixel `id` of the tile sees: the sky, and the stars before it.
fn keep(id: vec2<u32>, sky: vec4<f32>) {
    store(id, vec4(storable(sky.rgb + star_light(frame.first + id)), sky.a));
}
