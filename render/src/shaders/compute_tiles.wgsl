// The entry point of a compute pass that draws a filtered picture: a program for each tile class of classify_tiles.wgsl.
//
// An invocation draws ROWS pixels below each other: 1 on a GPU. A software adapter pays much for each invocation and for
// the look-up of its tile, so there it is a whole column of a tile. Its loop tests the condition at the end, because
// it executes a loop that begins with the test once more than the pixels take it.
// #import column
// #import constants
// #import filter
// #import keep
// #import output
// #import pixel
// #import ray_light
// #import region
// #import sky
// #import work_queues

// The tile class that the program draws.
override CLASS: u32 = 0u;

@group(0) @binding(4) var<storage, read> tiles: array<u32>;

// The first pixel of the region that invocation `local` of a workgroup draws, in the dispatch of its work queue.
fn top_of_column(dispatch: vec3<u32>, workgroup: vec3<u32>, local: vec3<u32>) -> vec2<u32> {
    let row = local.y * ROWS;
    let entry = (workgroup.y * dispatch.x + workgroup.x) * ROWS + row / TILE;
    let tile = tiles[first_tile(CLASS) + entry];
    return TILE * vec2(tile & 0xffffu, tile >> 16u) + vec2(local.x, row % TILE);
}

// Pixel `id` of the region, which is in a tile of the class.
fn pixel_of_class(id: vec2<u32>) -> vec4<f32> {
    switch CLASS {
        case SHADOW: {
            return kept(id, vec4(0.0));
        }
        case ONE_TAP: {
            return kept(id, ray_light(view_vector(id)));
        }
        case FIRST_LEVEL: {
            return kept(id, first_level_light(patch_at(from_middle(region.first + id), 1.0)));
        }
        case ONE_RAY: {
            return kept(id, patch_light(patch_at(from_middle(region.first + id), 1.0), MAX_TAPS));
        }
        default: {
            return pixel(id);
        }
    }
}

@compute @workgroup_size(TILE, TILE)
fn draw_tiles(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let first = top_of_column(dispatch, workgroup, local);
    begin_column(region.first + first);
    var row = 0u;
    loop {
        let id = first + vec2(0u, row);
        if all(id < region.count) {
            store(id, pixel_of_class(id));
        }
        row++;
        if row == ROWS {
            break;
        }
    }
}
