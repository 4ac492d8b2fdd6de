// The picture with a disc, each pixel averaged over its area. filter.rs is the reference in f64.
// #import disc_over
// #import filter
// #import keep_behind
// #import region

// A part of a pixel that sees the sky or the disc beyond the periapsis of its rays, and its share of its patch.
struct Outside {
    seen: Patch,
    covered: f32,
}

// The part of patch `i` of the pixel at `at`, of along × along patches, outside the shadow.
fn outside_of(i: u32, along: u32, at: vec2<f32>) -> Outside {
    let side = 1.0 / f32(along);
    let offset = (vec2(f32(i % along), f32(i / along)) + 0.5) * side - 0.5;
    let square = patch_at(at + offset, side);
    let px = gradient(square);
    let part = sky_part(shadow_distance(square.c, square.p, half_shadow()), px, half_shadow());
    return Outside(moved(square, part.shift * px, part.extent), part.covered);
}

// The light of the pixel `id` of the region. Beside the shadow's edge it is that of 3 × 3 patches; what is before the periapsis
// changes little within a pixel, also across the edge.
fn disc_pixel(id: vec2<u32>) -> vec4<f32> {
    let at = from_middle(region.first + id);
    let whole = patch_at(at, 1.0);
    let orbit = orbit_of(whole, 0.0);
    let rays = rays_of(whole);
    let is_edge = rays.along == SUB_RAYS;
    let count = select(1u, SUB_RAYS * SUB_RAYS, is_edge);
    var before = Before(orbit.inner, NO_CROSSING);
    var light = vec4(0.0);
    var through = 0.0;
    for (var i = 0u; i < count; i++) {
        // In the shadow, nothing is seen beyond the periapsis.
        var outside = Outside(whole, select(1.0, 0.0, rays.along == 0u));
        var here = orbit;
        for (var several = is_edge; several; several = false) {
            outside = outside_of(i, SUB_RAYS, at);
            here = orbit_of(outside.seen, 0.0);
        }
        let deflected = deflect_patch(outside.seen.c, outside.seen.p);
        let ray = leaving(deflected);
        for (var first = i == 0u; first; first = false) {
            before = before_periapsis(whole, orbit, ray);
        }
        let escapes = outside.covered > 0.0 && deflected.outcome == ESCAPES;
        let covered = select(0.0, outside.covered, escapes);
        var shares = vec2(0.0, 1.0 - disc.opacity * before.nearer.share);
        let uncovered = (1.0 - covered) * shares.y;
        for (var seen = escapes; seen; seen = false) {
            let farther = beyond_periapsis(outside.seen, here, ray, before);
            shares = shares_behind(before.nearer, farther);
            light += covered * light_of(outside.seen, here, farther, shares.x);
            for (var sky = shares.y > 0.0; sky; sky = false) {
                let mean = average(print_of(outside.seen, deflected), rays.most_taps);
                light += covered * shares.y * vec4(seen_light(mean, outside.seen.d), 1.0);
            }
        }
        through += uncovered + covered * shares.y;
    }
    let share = 1.0 / f32(count);
    let nearer = light_of(whole, orbit, before.nearer, before.nearer.share);
    return kept_behind(id, Veil(light * share + nearer, through * share));
}
