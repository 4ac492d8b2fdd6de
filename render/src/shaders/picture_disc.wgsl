// The picture with a disc, one ray per pixel.
// #import disc_over
// #import keep_behind
// #import sky
// #import view

// The light of pixel `id` of the region.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let seen = patch_of(view_direction(id), vec3(0.0), vec3(0.0));
    let orbit = orbit_of(seen, 0.0);
    let deflected = deflect_patch(seen.c, seen.p);
    let ray = leaving(deflected);
    let before = before_periapsis(seen, orbit, ray);
    var farther = NO_CROSSING;
    if deflected.outcome == ESCAPES {
        farther = beyond_periapsis(seen, orbit, ray, before);
    }
    let shares = shares_behind(before.nearer, farther);
    let light = light_of(seen, orbit, before.nearer, before.nearer.share)
        + light_of(seen, orbit, farther, shares.x)
        + shares.y * pixel_light(seen.d, seen.p, deflected);
    return kept_behind(id, Veil(light, shares.y));
}
