// Returns the value to store for pixel `id` of the region: the sky, and the stars in front of it.
// #import region
// #import star_light
// #import storable
fn kept(id: vec2<u32>, sky: vec4<f32>) -> vec4<f32> {
    return vec4(storable(sky.rgb + star_light(region.first + id)), sky.a);
}
