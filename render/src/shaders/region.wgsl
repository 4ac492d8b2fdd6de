// The rectangle of pixels that a pass draws. gpu/camera_block.rs has the same struct.
// #import camera
// #import constants
struct Region {
    // Its first pixel, its width and height.
    first: vec2<u32>,
    count: vec2<u32>,
    // Index of its first work queue, and of the first entry of that queue.
    queues: u32,
    tiles: u32,
    // Factor by which a difference is multiplied.
    gain: f32,
}

@group(0) @binding(1) var<uniform> region: Region;

// Whether invocation `id` of the dispatch has a pixel in the region.
fn in_region(id: vec3<u32>) -> bool {
    return all(id.xy < region.count);
}
