// The entry points of a compute pass that draws a filtered picture: a program for each tile class of
// classify_tiles.wgsl.
// #import constants
// #import filter
// #import keep
// #import output
// #import ray_light
// #import region
// #import sky
// #import work_queues

@group(0) @binding(4) var<storage, read> tiles: array<u32>;

// The pixel of the region that invocation `local` of a workgroup draws, in the dispatch of a work queue.
fn queued_pixel(queue: u32, dispatch: vec3<u32>, workgroup: vec3<u32>, local: vec3<u32>) -> vec3<u32> {
    let tile = tiles[first_tile(queue) + workgroup.y * dispatch.x + workgroup.x];
    return vec3(TILE * vec2(tile & 0xffffu, tile >> 16u) + local.xy, 0u);
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
    store(id.xy, kept(id.xy, ray_light(view_vector(id.xy))));
}

// Tile class OneRay: one ray per pixel, and the mean over its footprint.
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
    let seen = patch_at(from_middle(region.first + id.xy), 1.0);
    store(id.xy, kept(id.xy, patch_light(seen, MAX_TAPS)));
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
    let at = from_middle(region.first + id.xy);
    store(id.xy, kept(id.xy, light_by(rays_of(patch_at(at, 1.0)), at)));
}
