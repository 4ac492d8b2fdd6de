// The picture with a disc, each pixel averaged over its area. filter.rs is the reference in f64.
// #import disc_over
// #import filter
// #import keep_behind
// #import region

// A patch that sees only sky: its light.
fn sky_behind(outside: Patch, deflected: Deflected, most_taps: f32) -> Veiled {
    let light = average(print_of(outside, deflected), most_taps);
    return Veiled(vec4(seen_light(light, outside.d), 1.0), 1.0);
}

// The light of the pixel `id` of the region.
fn disc_pixel(id: vec2<u32>) -> vec4<f32> {
    let at = from_middle(region.first + id);
    let whole = patch_at(at, 1.0);
    let rays = rays_of(whole);
    var sum = Veiled(vec4(0.0), 1.0);
    if rays.along != SUB_RAYS {
        // In the shadow, or away from its edge.
        let deflected = deflect_patch(whole.c, whole.p);
        if deflected.outcome == ESCAPES {
            sum = sky_behind(whole, deflected, rays.most_taps);
        }
        sum = behind_disc(whole, deflected, sum);
    } else {
        sum = light_beside_edge(at, rays.most_taps);
    }
    return kept_behind(id, sum);
}

// The mean light of the pixel at `at`, beside the shadow's edge.
fn light_beside_edge(at: vec2<f32>, most_taps: f32) -> Veiled {
    let half_angle = half_shadow();
    let side = 1.0 / f32(SUB_RAYS);
    var sum = Veiled(vec4(0.0), 0.0);
    for (var i = 0u; i < SUB_RAYS * SUB_RAYS; i++) {
        let offset = (vec2(f32(i % SUB_RAYS), f32(i / SUB_RAYS)) + 0.5) * side - 0.5;
        let square = patch_at(at + offset, side);
        let px = gradient(square);
        let part = sky_part(shadow_distance(square.c, square.p, half_angle), px, half_angle);
        var light = Veiled(vec4(0.0), 1.0);
        if part.covered > 0.0 {
            let outside = moved(square, part.shift * px, part.extent);
            let deflected = deflect_patch(outside.c, outside.p);
            if deflected.outcome == ESCAPES {
                light = behind_outward(outside, deflected, sky_behind(outside, deflected, most_taps));
                light.light *= part.covered;
                light.through = 1.0 - part.covered * (1.0 - light.through);
            }
        }
        let seen = behind_inward(square, light);
        sum.light += seen.light;
        sum.through += seen.through;
    }
    return Veiled(sum.light * (side * side), sum.through * (side * side));
}
