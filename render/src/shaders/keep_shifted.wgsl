// Stores pixel `id` of the region: the sky alone, whose frequency shift may make it brighter than a pixel can hold.
// #import output
fn keep(id: vec2<u32>, sky: vec4<f32>) {
    store(id, vec4(storable(sky.rgb), sky.a));
}
