// The entry points of a compute pass that draws a filtered picture: a program for each tile class of
// classify_tiles.wgsl.
//
// An invocation draws ROWS pixels below each other: 1 on a GPU. A software adapter pays much for each invocation and for
// the look-up of its tile, so there it is a whole column of a tile. Its loops test their condition at the end, because
// it executes a loop that begins with the test once more than the pixels take it.
// #import constants
// #import filter
// #import keep
// #import output
// #import ray_light
// #import region
// #import sky
// #import work_queues

@group(0) @binding(4) var<storage, read> tiles: array<u32>;

// The first pixel of the region that invocation `local` of a workgroup draws, in the dispatch of a work queue.
fn top_of_column(queue: u32, dispatch: vec3<u32>, workgroup: vec3<u32>, local: vec3<u32>) -> vec2<u32> {
    let row = local.y * ROWS;
    let entry = (workgroup.y * dispatch.x + workgroup.x) * ROWS + row / TILE;
    let tile = tiles[first_tile(queue) + entry];
    return TILE * vec2(tile & 0xffffu, tile >> 16u) + vec2(local.x, row % TILE);
}

// Tile class Shadow: no sky.
@compute @workgroup_size(TILE, TILE)
fn shadow(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let first = top_of_column(SHADOW, dispatch, workgroup, local);
    var row = 0u;
    loop {
        let id = first + vec2(0u, row);
        if all(id < region.count) {
            store(id, kept(id, vec4(0.0)));
        }
        row++;
        if row == ROWS {
            break;
        }
    }
}

// Tile class OneTap: magnified sky with one bilinear tap per pixel.
@compute @workgroup_size(TILE, TILE)
fn one_tap(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let first = top_of_column(ONE_TAP, dispatch, workgroup, local);
    var row = 0u;
    loop {
        let id = first + vec2(0u, row);
        if all(id < region.count) {
            store(id, kept(id, ray_light(view_vector(id))));
        }
        row++;
        if row == ROWS {
            break;
        }
    }
}

// Tile class FirstLevel: one ray per pixel, and the mean over its footprint by taps in the first mip level.
@compute @workgroup_size(TILE, TILE)
fn first_level(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let first = top_of_column(FIRST_LEVEL, dispatch, workgroup, local);
    var row = 0u;
    loop {
        let id = first + vec2(0u, row);
        if all(id < region.count) {
            let seen = patch_at(from_middle(region.first + id), 1.0);
            store(id, kept(id, first_level_light(seen)));
        }
        row++;
        if row == ROWS {
            break;
        }
    }
}

// Tile class OneRay: one ray per pixel, and the mean over its footprint.
@compute @workgroup_size(TILE, TILE)
fn one_ray(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let first = top_of_column(ONE_RAY, dispatch, workgroup, local);
    var row = 0u;
    loop {
        let id = first + vec2(0u, row);
        if all(id < region.count) {
            let seen = patch_at(from_middle(region.first + id), 1.0);
            store(id, kept(id, patch_light(seen, MAX_TAPS)));
        }
        row++;
        if row == ROWS {
            break;
        }
    }
}

// Tile class ManyRays, near the shadow's edge: no ray per pixel, one, or several.
@compute @workgroup_size(TILE, TILE)
fn many_rays(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let first = top_of_column(MANY_RAYS, dispatch, workgroup, local);
    var row = 0u;
    loop {
        let id = first + vec2(0u, row);
        if all(id < region.count) {
            let at = from_middle(region.first + id);
            let whole = patch_at(at, 1.0);
            store(id, kept(id, light_by(rays_of(whole), whole, at)));
        }
        row++;
        if row == ROWS {
            break;
        }
    }
}
