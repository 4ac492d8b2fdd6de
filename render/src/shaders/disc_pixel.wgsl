// The picture with a disc, each pixel averaged over its area. filter.rs is the reference in f64.
// #import disc_over
// #import filter
// #import keep_behind
// #import region

// The mean light of the sky over a patch.
fn sky_of(outside: Patch, deflected: Deflected, most_taps: f32) -> vec4<f32> {
    let light = average(print_of(outside, deflected), most_taps);
    return vec4(seen_light(light, outside.d), 1.0);
}

// The light of the pixel `id` of the region.
fn disc_pixel(id: vec2<u32>) -> vec4<f32> {
    let at = from_middle(region.first + id);
    let whole = patch_at(at, 1.0);
    let rays = rays_of(whole);
    var sum = NO_VEIL;
    // In the shadow, or away from its edge.
    for (var one = rays.along != SUB_RAYS; one; one = false) {
        let deflected = deflect_patch(whole.c, whole.p);
        sum = veil_of(whole, deflected);
        for (var sky = sum.through > 0.0 && deflected.outcome == ESCAPES; sky; sky = false) {
            sum.light += sum.through * sky_of(whole, deflected, rays.most_taps);
        }
    }
    for (var several = rays.along == SUB_RAYS; several; several = false) {
        sum = light_beside_edge(whole, at, rays.most_taps);
    }
    return kept_behind(id, sum);
}

// The mean light of the pixel at `at`, beside the shadow's edge, and the share of the light of stars that gets through the
// disc. `whole` is the patch of the pixel.
fn light_beside_edge(whole: Patch, at: vec2<f32>, most_taps: f32) -> Veil {
    let half_angle = half_shadow();
    let side = 1.0 / f32(SUB_RAYS);
    let orbit = orbit_of(whole, 0.0);
    let leaves = has_outward_leg(orbit);
    var beyond = Veil(vec4(0.0), 0.0);
    for (var i = 0u; i < SUB_RAYS * SUB_RAYS; i++) {
        let offset = (vec2(f32(i % SUB_RAYS), f32(i / SUB_RAYS)) + 0.5) * side - 0.5;
        let square = patch_at(at + offset, side);
        let px = gradient(square);
        let part = sky_part(shadow_distance(square.c, square.p, half_angle), px, half_angle);
        if part.covered > 0.0 {
            let outside = moved(square, part.shift * px, part.extent);
            let seen = light_beyond(outside, orbit, leaves, most_taps);
            beyond.light += seen.light * part.covered;
            beyond.through += 1.0 - part.covered * (1.0 - seen.through);
        } else {
            beyond.through += 1.0;
        }
    }
    // What is before the periapsis changes little within a pixel, also across the edge.
    let before = veil_before(whole, orbit);
    let share = side * side;
    return Veil(before.light + beyond.light * (share * before.through), before.through * beyond.through * share);
}

// The light of a patch outside the shadow from beyond the periapsis of its rays, whose orbit is nearly `orbit`. `leaves` is
// whether such rays may meet the disc there.
fn light_beyond(outside: Patch, orbit: Orbit, leaves: bool, most_taps: f32) -> Veil {
    let deflected = deflect_patch(outside.c, outside.p);
    if deflected.outcome != ESCAPES {
        return NO_VEIL;
    }
    var seen = NO_VEIL;
    for (var disc_too = leaves; disc_too; disc_too = false) {
        seen = veil_beyond(outside, orbit, deflected);
    }
    for (var sky = seen.through > 0.0; sky; sky = false) {
        seen.light += seen.through * sky_of(outside, deflected, most_taps);
    }
    return seen;
}
