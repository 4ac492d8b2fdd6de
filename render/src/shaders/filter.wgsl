// The picture, each pixel averaged over its area. filter.rs explains the method and is the reference in f64. There
// are three programs, one for each tile class of classify_tiles.wgsl.
// #import arithmetic
// #import constants
// #import deflect
// #import footprint
// #import keep
// #import region
// #import shadow
// #import sky
// #import view
// #import work_queues

@group(0) @binding(4) var<storage, read> tiles: array<u32>;

// The pixel of the region that invocation `local` of a workgroup draws, in the dispatch of a work queue.
fn queued_pixel(queue: u32, dispatch: vec3<u32>, workgroup: vec3<u32>, local: vec3<u32>) -> vec3<u32> {
    let tile = tiles[first_tile(queue) + workgroup.y * dispatch.x + workgroup.x];
    return vec3(TILE * vec2(tile & 0xffffu, tile >> 16u) + local.xy, 0u);
}

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
    let spread = taps(print, f32(textureDimensions(sky).x), most_taps);
    // From tap to tap the direction turns by the same angle.
    let first = cos_sin(-0.5 * (spread.count - 1.0) * spread.step);
    let step = cos_sin(spread.step);
    var d = print.d * first.x + spread.along * first.y;
    var along = spread.along * first.x - print.d * first.y;
    var sum = vec3(0.0);
    for (var i = 0.0; i < spread.count; i += 1.0) {
        sum += textureSampleLevel(sky, sky_sampler, d, spread.level).rgb;
        let next = d * step.x + along * step.y;
        along = along * step.x - d * step.y;
        d = next;
    }
    return vec4(seen_light(sum / spread.count, seen.d), 1.0);
}

// Tile class OneTap: magnified sky with one bilinear tap per pixel, or no sky.
@compute @workgroup_size(TILE, TILE)
fn one_tap(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let id = queued_pixel(ONE_TAP, dispatch, workgroup, local);
    if !in_region(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    keep(id.xy, pixel_light(d, p, deflect(-d.z, p)));
}

// Tile class OneRay: one ray per pixel, and taps along its footprint.
@compute @workgroup_size(TILE, TILE)
fn one_ray(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let id = queued_pixel(ONE_RAY, dispatch, workgroup, local);
    if !in_region(id) {
        return;
    }
    keep(id.xy, patch_light(patch_at(from_middle(region.first + id.xy), 1.0), MAX_TAPS));
}

// Tile class ManyRays, near the shadow's edge: no ray per pixel, one, or one for each of 3 × 3 patches.
@compute @workgroup_size(TILE, TILE)
fn many_rays(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let id = queued_pixel(MANY_RAYS, dispatch, workgroup, local);
    if !in_region(id) {
        return;
    }
    let half_angle = half_shadow();
    let at = from_middle(region.first + id.xy);
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
    keep(id.xy, sum * (side * side));
}
