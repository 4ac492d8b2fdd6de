// Pixel `id` of the region as it is kept: the sky alone.
fn kept(id: vec2<u32>, sky: vec4<f32>) -> vec4<f32> {
    return sky;
}
