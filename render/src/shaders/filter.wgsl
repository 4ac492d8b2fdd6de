// The picture, each pixel averaged over its area. filter.rs explains the method and is the reference in f64.
// #import average
// #import constants
// #import deflect
// #import footprint
// #import region
// #import shadow
// #import view

// The mean light of a patch that sees only sky, with alpha 1; 0 if its ray is captured.
fn patch_light(seen: Patch, most_taps: f32) -> vec4<f32> {
    let deflected = deflect_patch(seen.c, seen.p);
    if deflected.outcome != ESCAPES {
        return vec4(0.0);
    }
    return vec4(seen_light(average(print_of(seen, deflected), most_taps), seen.d), 1.0);
}

// The footprint of a patch in the frame of the cube.
fn print_of(seen: Patch, deflected: Deflected) -> Footprint {
    let in_hole = footprint(seen, deflected);
    return Footprint(
        in_sky_frame(in_hole.d),
        in_sky_frame(in_hole.right),
        in_sky_frame(in_hole.down),
    );
}

// Rays along each side of a pixel, and the largest number of taps of each of them.
struct Rays {
    along: u32,
    most_taps: f32,
}

// The rays of a pixel: none in the shadow, one away from its edge, several beside it.
fn rays_of(whole: Patch) -> Rays {
    let distance = shadow_distance(whole.c, whole.p, half_shadow()) / gradient(whole);
    if distance >= NEAR_OUTSIDE {
        return Rays(1u, MAX_TAPS);
    }
    return Rays(select(SUB_RAYS, 0u, distance < -NEAR_INSIDE), MAX_TAPS_BESIDE_EDGE);
}

// The mean light of the pixel at `at` by these rays, each for a square patch.
fn light_by(rays: Rays, at: vec2<f32>) -> vec4<f32> {
    let half_angle = half_shadow();
    let along = rays.along;
    let side = 1.0 / f32(max(along, 1u));
    var sum = vec4(0.0);
    for (var i = 0u; i < along * along; i++) {
        let offset = (vec2(f32(i % along), f32(i / along)) + 0.5) * side - 0.5;
        let square = patch_at(at + offset, side);
        let px = gradient(square);
        let part = sky_part(shadow_distance(square.c, square.p, half_angle), px, half_angle);
        if part.covered > 0.0 {
            let outside = moved(square, part.shift * px, part.extent);
            sum += part.covered * patch_light(outside, rays.most_taps);
        }
    }
    return sum * (side * side);
}
