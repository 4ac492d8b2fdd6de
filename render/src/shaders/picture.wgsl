// The picture, one ray per pixel.
// #import deflect
// #import keep
// #import sky
// #import view

// The light of pixel `id` of the region.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let d = view_direction(id);
    let p = length(d.xy);
    return kept(id, pixel_light(d, p, deflect(-d.z, p)));
}
