// The blocks of pixels of a tile, listed by what their pixels take at the most: filtered::Need. Each list has
// room for all of them, and the last row of its workgroups is filled up with blocks of no picture.

// Side of a block, pixels.
const BLOCK: u32 = 8u;
// Workgroups to a row of a dispatch at the most: WebGPU's limit.
const MOST_ACROSS: u32 = 65535u;
// Room in a list for blocks of no picture: one less than there are rows.
const SPARE: u32 = 64u;

const ONE_TAP: u32 = 0u;
const ONE_RAY: u32 = 1u;
const MANY_RAYS: u32 = 2u;

// Pixels from the edge, outside and inside the shadow, within which a pixel takes many rays.
const NEAR_OUTSIDE: f32 = 3.0;
const NEAR_INSIDE: f32 = 1.0;

// Columns and rows of blocks of the tile.
fn blocks_of_tile() -> vec2<u32> {
    return (frame.count + BLOCK - 1u) / BLOCK;
}

// Where a list of the tile begins.
fn first_block(list: u32) -> u32 {
    let in_tile = blocks_of_tile();
    return frame.blocks + list * (in_tile.x * in_tile.y + SPARE);
}
