// The picture, each pixel averaged over its area. filter.rs explains the method and is the reference in f64.
// #import average
// #import constants
// #import coverage
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

// The same for a pixel whose taps are all in the first mip level.
fn first_level_light(seen: Patch) -> vec4<f32> {
    let deflected = deflect_patch(seen.c, seen.p);
    if deflected.outcome != ESCAPES {
        return vec4(0.0);
    }
    return vec4(seen_light(first_level_average(print_of(seen, deflected)), seen.d), 1.0);
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

// A part of a pixel that sees the sky, and its share of the pixel's area.
struct Part {
    seen: Patch,
    share: f32,
}

// The mean light of the pixel at `at` by these rays: one for the whole pixel, or one for each strip along the shadow's edge
// of the part that sees the sky. In place of strips, the edge of a shadow of few pixels takes 3 × 3 patches.
fn light_by(rays: Rays, whole: Patch, at: vec2<f32>) -> vec4<f32> {
    var sum = vec4(0.0);
    if rays.along > 0u {
        let is_one = rays.along == 1u;
        let px = gradient(whole);
        let is_straight = 2.0 * min(camera.half_shadow_cos, camera.half_shadow_sin) >= STRAIGHT_EDGE * px;
        let across = vec2(whole.right.x, whole.down.x) / px;
        let reach = 0.5 * (abs(across.x) + abs(across.y));
        let edge = -shadow_distance(whole.c, whole.p, half_shadow()) / px;
        var near = select(clamp(edge, -reach, reach), -0.5, is_one);
        let width = select((reach - near) / f32(STRIPS), 1.0, is_one);
        var before = select(positive_share(near, across.x, across.y), 0.0, is_one);
        let several = select(SUB_RAYS * SUB_RAYS, STRIPS, is_straight);
        var left = select(several, 1u, is_one);
        loop {
            left--;
            let far = near + width;
            let through = select(positive_share(far, across.x, across.y), 1.0, left == 0u);
            var part = Part(moved(whole, 0.5 * (near + far) * px, width), through - before);
            if !is_straight && !is_one {
                part = square_part(left, at);
            }
            sum += part.share * patch_light(part.seen, rays.most_taps);
            near = far;
            before = through;
            if left == 0u {
                break;
            }
        }
    }
    return sum;
}

// The part outside the shadow of patch `i` of the 3 × 3 patches of the pixel at `at`.
fn square_part(i: u32, at: vec2<f32>) -> Part {
    let side = 1.0 / f32(SUB_RAYS);
    let offset = (vec2(f32(i % SUB_RAYS), f32(i / SUB_RAYS)) + 0.5) * side - 0.5;
    let square = patch_at(at + offset, side);
    let px = gradient(square);
    let part = sky_part(shadow_distance(square.c, square.p, half_shadow()), px, half_shadow());
    return Part(moved(square, part.shift * px, part.extent), part.covered * side * side);
}
