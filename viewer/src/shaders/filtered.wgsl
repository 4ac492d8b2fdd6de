// The picture, each pixel averaged over its area. Twin of filtered.rs, which says how. Three programs,
// each for the blocks of pixels that need no more, as sort_blocks.wgsl has listed them.

// Rays along the side of a pixel beside the edge.
const SUB_RAYS: u32 = 3u;
// Taps along the long axis of a ray's footprint at the most: if it is its pixel's only ray, and beside
// the edge.
const MOST_TAPS: f32 = 16.0;
const MOST_TAPS_BESIDE_EDGE: f32 = 8.0;

@group(0) @binding(3) var<storage, read> blocks: array<u32>;

// The pixel of the tile that the invocation `local` of a workgroup draws, in a dispatch of one of the lists.
fn listed_pixel(list: u32, dispatch: vec3<u32>, workgroup: vec3<u32>, local: vec3<u32>) -> vec3<u32> {
    let block = blocks[first_block(list) + workgroup.y * dispatch.x + workgroup.x];
    return vec3(BLOCK * vec2(block & 0xffffu, block >> 16u) + local.xy, 0u);
}

// The middle of the pixel `id` of the tile, in pixels from the picture's middle.
fn position(id: vec3<u32>) -> vec2<f32> {
    return vec2<f32>(frame.first + id.xy) + 0.5 - 0.5 * vec2<f32>(frame.size);
}

// The square of `side` pixels about `at`, in pixels from the picture's middle.
fn patch_at(at: vec2<f32>, side: f32) -> Patch {
    let ray = frame.forward + frame.right * at.x + frame.down * at.y;
    return patch_of(ray, frame.right * side, frame.down * side);
}

// The mean light of a patch that sees nothing but sky, alpha 1; 0 if its ray is captured.
fn patch_light(seen: Patch, most_taps: f32) -> vec4<f32> {
    let turned = deflect(seen.c, seen.p);
    if turned.fate != ESCAPES {
        return vec4(0.0);
    }
    let in_hole = footprint(seen, turned);
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
    return vec4(sum / spread.count, 1.0);
}

// Magnified sky, or none.
@compute @workgroup_size(8, 8)
fn one_tap(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let id = listed_pixel(ONE_TAP, dispatch, workgroup, local);
    if !in_tile(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    keep(id.xy, pixel_light(d, p, deflect(-d.z, p)));
}

// One ray a pixel, and taps along its footprint.
@compute @workgroup_size(8, 8)
fn one_ray(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let id = listed_pixel(ONE_RAY, dispatch, workgroup, local);
    if !in_tile(id) {
        return;
    }
    keep(id.xy, patch_light(patch_at(position(id), 1.0), MOST_TAPS));
}

// Beside the edge: no ray a pixel, one, or one for each of 3 × 3 patches.
@compute @workgroup_size(8, 8)
fn many_rays(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let id = listed_pixel(MANY_RAYS, dispatch, workgroup, local);
    if !in_tile(id) {
        return;
    }
    let half_edge = vec2(frame.half_edge_cos, frame.half_edge_sin);
    let at = position(id);
    let whole = patch_at(at, 1.0);
    let distance = shadow_distance(whole.c, whole.p, half_edge) / gradient(whole);
    var along = SUB_RAYS;
    var most_taps = MOST_TAPS_BESIDE_EDGE;
    if distance >= NEAR_OUTSIDE {
        along = 1u;
        most_taps = MOST_TAPS;
    } else if distance < -NEAR_INSIDE {
        along = 0u;
    }
    let side = 1.0 / f32(max(along, 1u));
    var sum = vec4(0.0);
    for (var i = 0u; i < along * along; i++) {
        let offset = (vec2(f32(i % along), f32(i / along)) + 0.5) * side - 0.5;
        let square = patch_at(at + offset, side);
        let px = gradient(square);
        let part = sky_part(shadow_distance(square.c, square.p, half_edge), px, half_edge);
        if part.covered > 0.0 {
            let outside = moved(square, part.shift * px, part.extent);
            sum += part.covered * patch_light(outside, most_taps);
        }
    }
    keep(id.xy, sum * (side * side));
}
