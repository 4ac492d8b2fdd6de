// The work queues of a region: its tiles of 8 × 8 pixels, in one queue for each tile class (filter::TileClass).
// Each queue has room for all tiles of the region and for PADDING more entries. Its entries are drawn by workgroups of
// ROWS tiles.
// #import constants
// #import region

// Largest number of workgroups in a row of a dispatch: WebGPU's limit. A longer queue takes several rows of
// workgroups, of which the last is filled up with padding entries.
const MAX_WORKGROUPS_PER_ROW: u32 = 65535u;
// A padding entry: it is outside every region.
const NO_TILE: u32 = 0xffffffffu;

// Rows of a tile that one invocation draws: a divisor of TILE.
override ROWS: u32 = 1u;

const SHADOW: u32 = 0u;
const ONE_TAP: u32 = 1u;
const FIRST_LEVEL: u32 = 2u;
const ONE_RAY: u32 = 3u;
const MANY_RAYS: u32 = 4u;

// Columns and rows of tiles of the region.
fn tiles_of_region() -> vec2<u32> {
    return (region.count + TILE - 1u) / TILE;
}

// Index of the first entry of a queue of the region.
fn first_tile(queue: u32) -> u32 {
    let in_region = tiles_of_region();
    return region.tiles + queue * (in_region.x * in_region.y + PADDING);
}
