// Tile classification: puts each tile into the work queue of the simplest program that can draw all its pixels. A
// GPU waits for the slowest pixel of a workgroup, and a software adapter executes every branch, so programs of
// their own draw the few expensive tiles.
// #import arithmetic
// #import deflect
// #import footprint
// #import ray
// #import shadow
// #import sky
// #import view
// #import work_queues

// Rounding error of the distance from the shadow's edge in f32, rad.
const ROUNDING: f32 = 1e-6;

// The arguments of an indirect dispatch, and the number of tiles that it draws.
struct Queue {
    across: u32,
    rows: u32,
    deep: u32,
    count: atomic<u32>,
}

@group(0) @binding(3) var<storage, read_write> queues: array<Queue>;
// The entries of the work queues: column and row of a tile in 16 bits each.
@group(0) @binding(4) var<storage, read_write> tiles: array<u32>;

// The class of a tile, which is at least that of each of its pixels. `corner` is the upper left corner of the
// tile, in pixels from that of the picture.
fn class_of_tile(corner: vec2<f32>) -> u32 {
    let side = f32(TILE);
    let at = corner + 0.5 * side - 0.5 * vec2<f32>(camera.size);
    let half_diagonal = 0.70710678 * side;
    let seen_px = largest_pixel(at, half_diagonal);
    // As the observer of the row sees them: at most this wide.
    let scale = largest_scale(at, half_diagonal * seen_px);
    let px = scale * seen_px;
    let reach = half_diagonal * px;
    let rounding = scale * ROUNDING;

    let d = direction_at(at);
    let c = -d.z;
    let p = length(d.xy);
    let distance = shadow_distance(c, p, half_shadow());
    if distance < -NEAR_INSIDE * px - reach - rounding {
        return SHADOW;
    }
    if distance < NEAR_OUTSIDE * px + reach + rounding {
        return MANY_RAYS;
    }
    // The deflection angle Δ (bending) is largest at the point of the tile nearest to the hole.
    let t = cos_sin(reach);
    let towards = vec2(c * t.x + p * t.y, abs(p * t.x - c * t.y));
    let deflected = deflect_patch(towards.x, towards.y);
    if deflected.outcome != ESCAPES {
        return MANY_RAYS;
    }
    let radial = deflected.radial;
    let least_sin = min(towards.y, p * t.x + c * t.y);
    let most_sin = abs(deflected.sin_sky) + 2.0 * reach * radial;
    // Straight away from the hole the radial and the tangential derivative are equal.
    let tangential = select(1.1 * radial, most_sin / least_sin, least_sin > 2.0 * reach);
    let size = abs(in_sky_frame(turn_direction(d, p, deflected)));
    let depth = max(size.x, max(size.y, size.z)) - 2.0 * reach * max(radial, tangential);
    if depth <= 0.0 {
        return ONE_RAY;
    }
    let texels = 0.5 * f32(textureDimensions(sky).x) * px / (depth * depth);
    let long = texels * max(radial, tangential);
    let short = texels * min(radial, tangential);
    let is_short = short <= 1.0;
    if long * long + short * short < ONE_TAP_SQ || (is_short && long <= ONE_TAP_LONG) {
        return ONE_TAP;
    }
    return select(ONE_RAY, FIRST_LEVEL, is_short && long <= SPACING * MAX_TAPS);
}

@compute @workgroup_size(64)
fn classify_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let across = tiles_of_region().x;
    let tile = vec2(id.x % across, id.x / across);
    if tile.y < tiles_of_region().y {
        let queue = class_of_tile(vec2<f32>(region.first + TILE * tile));
        let entry = atomicAdd(&queues[region.queues + queue].count, 1u);
        tiles[first_tile(queue) + entry] = tile.x | (tile.y << 16u);
    }
}

// Writes the arguments of each queue's indirect dispatch and pads its last row of workgroups: one workgroup per
// queue. The rows are as short as their number allows, so there are at most ROWS padding entries per row.
@compute @workgroup_size(PADDING)
fn close_queues(
    @builtin(workgroup_id) queue: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let index = region.queues + queue.x;
    let count = atomicLoad(&queues[index].count);
    let workgroups = (count + ROWS - 1u) / ROWS;
    let rows = (workgroups + MAX_WORKGROUPS_PER_ROW - 1u) / MAX_WORKGROUPS_PER_ROW;
    let across = (workgroups + rows - 1u) / max(rows, 1u);
    let entry = count + local.x;
    if entry < rows * across * ROWS {
        tiles[first_tile(queue.x) + entry] = NO_TILE;
    }
    if local.x == 0u {
        queues[index].across = across;
        queues[index].rows = rows;
        queues[index].deep = 1u;
    }
}
