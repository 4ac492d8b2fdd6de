// Puts each block of pixels into the list of the least program that will do: a GPU waits for the slowest pixel
// of a group, and a software one runs through every branch; so the few pixels that take much are kept apart
// from the many that take one tap.

// What 32-bit floats may make of the distance from the edge, rad.
const ROUNDING: f32 = 1e-6;

// A dispatch of workgroups, and how many blocks it is for.
struct List {
    across: u32,
    rows: u32,
    deep: u32,
    count: atomic<u32>,
}

@group(0) @binding(2) var<storage, read_write> lists: array<List>;
// Column and row of blocks in 16 bits each.
@group(0) @binding(3) var<storage, read_write> blocks: array<u32>;

// What the pixels of a block take at the most, never less than any of them does. `corner` is its upper left
// corner, from that of the picture.
fn need_of_block(corner: vec2<f32>) -> u32 {
    let side = f32(BLOCK);
    let at = corner + 0.5 * side - 0.5 * vec2<f32>(frame.size);
    let half_diagonal = 0.70710678 * side;
    // A pixel is the wider the nearer it is to the middle of the picture.
    let step = length(frame.right);
    let nearest = step * max(length(at) - half_diagonal, 0.0);
    let px = step * inverseSqrt(nearest * nearest + 1.0);
    let reach = half_diagonal * px;

    let d = normalize(frame.forward + frame.right * at.x + frame.down * at.y);
    let c = -d.z;
    let p = length(d.xy);
    let distance = shadow_distance(c, p, vec2(frame.half_edge_cos, frame.half_edge_sin));
    if distance < -NEAR_INSIDE * px - reach - ROUNDING {
        return ONE_TAP;
    }
    if distance < NEAR_OUTSIDE * px + reach + ROUNDING {
        return MANY_RAYS;
    }
    // The bending is the stronger the nearer to the hole.
    let t = cos_sin(reach);
    let towards = vec2(c * t.x + p * t.y, abs(p * t.x - c * t.y));
    let turned = deflect(towards.x, towards.y);
    if turned.fate != ESCAPES {
        return MANY_RAYS;
    }
    let stretch = 1.0 - turned.slope;
    let least_sin = min(towards.y, p * t.x + c * t.y);
    let most_sin = abs(turned.sin_sky) + 2.0 * reach * stretch;
    // Both stretches are the same straight away from the hole.
    let about = select(1.1 * stretch, most_sin / least_sin, least_sin > 2.0 * reach);
    let size = abs(in_sky_frame(turn_direction(d, p, turned)));
    let depth = max(size.x, max(size.y, size.z)) - 2.0 * reach * max(stretch, about);
    let texels = 0.5 * f32(textureDimensions(sky).x) * px / (depth * depth);
    let magnified = texels * texels * (stretch * stretch + about * about) < ONE_TAP_SQ;
    return select(ONE_RAY, ONE_TAP, depth > 0.0 && magnified);
}

@compute @workgroup_size(64)
fn sort_blocks(@builtin(global_invocation_id) id: vec3<u32>) {
    let across = blocks_of_tile().x;
    let block = vec2(id.x % across, id.x / across);
    if block.y < blocks_of_tile().y {
        let list = need_of_block(vec2<f32>(frame.first + BLOCK * block));
        let place = atomicAdd(&lists[frame.lists + list].count, 1u);
        blocks[first_block(list) + place] = block.x | (block.y << 16u);
    }
}

// Says how many workgroups each list takes, in rows of the same length, and fills up the last: a workgroup a
// list. Few are left over, for a GPU may deal them out by halves.
@compute @workgroup_size(SPARE)
fn close_lists(
    @builtin(workgroup_id) list: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let index = frame.lists + list.x;
    let count = atomicLoad(&lists[index].count);
    let rows = (count + MOST_ACROSS - 1u) / MOST_ACROSS;
    let across = (count + rows - 1u) / max(rows, 1u);
    let place = count + local.x;
    if place < rows * across {
        blocks[first_block(list.x) + place] = 0xffffffffu;
    }
    if local.x == 0u {
        lists[index].across = across;
        lists[index].rows = rows;
        lists[index].deep = 1u;
    }
}
