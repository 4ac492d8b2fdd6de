// The picture with a disc, one ray per pixel.
// #import disc_over
// #import keep_behind
// #import sky
// #import view

// The light of pixel `id` of the region.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let seen = patch_of(view_direction(id), vec3(0.0), vec3(0.0));
    let deflected = deflect_patch(seen.c, seen.p);
    let sky = Veiled(pixel_light(seen.d, seen.p, deflected), 1.0);
    return kept_behind(id, behind_disc(seen, deflected, sky));
}
