// Returns the value to store for pixel `id` of the region: the sky and the disc, and the stars that are seen through it.
// #import region
// #import star_light
// #import storable
// #import veil
fn kept_behind(id: vec2<u32>, seen: Veil) -> vec4<f32> {
    let stars = star_light(region.first + id) * seen.through;
    return vec4(storable(seen.light.rgb + stars), seen.light.a);
}
