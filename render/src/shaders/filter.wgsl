// The picture, each pixel averaged over its area. filter.rs explains the method and is the reference in f64.
// #import average
// #import constants
// #import deflect
// #import footprint
// #import keep
// #import region
// #import shadow
// #import view

// The mean light of a patch that sees only sky, with alpha 1; 0 if its ray is captured.
fn patch_light(seen: Patch, most_taps: f32) -> vec4<f32> {
    let deflected = deflect_patch(seen.c, seen.p);
    if deflected.outcome != ESCAPES {
        return vec4(0.0);
    }
    let in_hole = footprint(seen, deflected);
    let print = Footprint(
        in_sky_frame(in_hole.d),
        in_sky_frame(in_hole.right),
        in_sky_frame(in_hole.down),
    );
    return vec4(seen_light(average(print, most_taps), seen.d), 1.0);
}

// Pixel `id` of the region by one ray, far enough from the shadow's edge.
fn pixel_of_one_ray(id: vec2<u32>) -> vec4<f32> {
    return kept(id, patch_light(patch_at(from_middle(region.first + id), 1.0), MAX_TAPS));
}

// Pixel `id` of the region, anywhere: by no ray, by one, or by one for each of 3 × 3 patches. A software adapter
// executes both sides of a branch but ends a loop that has no pixel left, so the number of rays is that of a loop.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let half_angle = half_shadow();
    let at = from_middle(region.first + id);
    let whole = patch_at(at, 1.0);
    let distance = shadow_distance(whole.c, whole.p, half_angle) / gradient(whole);
    var along = SUB_RAYS;
    var most_taps = MAX_TAPS_BESIDE_EDGE;
    if distance >= NEAR_OUTSIDE {
        along = 1u;
        most_taps = MAX_TAPS;
    } else if distance < -NEAR_INSIDE {
        along = 0u;
    }
    let side = 1.0 / f32(max(along, 1u));
    var sum = vec4(0.0);
    for (var i = 0u; i < along * along; i++) {
        let offset = (vec2(f32(i % along), f32(i / along)) + 0.5) * side - 0.5;
        let square = patch_at(at + offset, side);
        let px = gradient(square);
        let part = sky_part(shadow_distance(square.c, square.p, half_angle), px, half_angle);
        if part.covered > 0.0 {
            let outside = moved(square, part.shift * px, part.extent);
            sum += part.covered * patch_light(outside, most_taps);
        }
    }
    return kept(id, sum * (side * side));
}
