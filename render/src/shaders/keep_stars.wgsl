// Stores pixel `id` of the region: the sky, and the stars in front of it.
// #import output
// #import region
// #import star_light
fn keep(id: vec2<u32>, sky: vec4<f32>) {
    store(id, vec4(storable(sky.rgb + star_light(region.first + id)), sky.a));
}
