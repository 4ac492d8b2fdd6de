// Returns the value to store for pixel `id` of the region: the sky and the disc, which may be brighter than a pixel can
// hold.
// #import storable
// #import veil
fn kept_behind(id: vec2<u32>, seen: Veil) -> vec4<f32> {
    return vec4(storable(seen.light.rgb), seen.light.a);
}
