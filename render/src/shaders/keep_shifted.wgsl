// Returns the value to store for pixel `id` of the region: the sky alone. The frequency shift may make it brighter than
// a pixel can hold.
// #import storable
fn kept(id: vec2<u32>, sky: vec4<f32>) -> vec4<f32> {
    return vec4(storable(sky.rgb), sky.a);
}
