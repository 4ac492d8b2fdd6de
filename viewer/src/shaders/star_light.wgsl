// The light of the stars that falls on a pixel: from the list of its tile, which stars.wgsl has made.

struct Node {
    // The point, in pixels from the picture's top left corner.
    at: vec2<f32>,
    reach: f32,
    // 1 + the index of the next of the list; 0 at its end.
    next: u32,
    light: vec3<f32>,
}

// After the number of nodes, 1 + the index of each tile's first node, row-major.
@group(2) @binding(0) var<storage, read> heads: array<u32>;
@group(2) @binding(1) var<storage, read> nodes: array<Node>;

fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    let tile = pixel / STAR_TILE;
    let across = (frame.size.x + STAR_TILE - 1u) / STAR_TILE;
    var next = heads[1u + tile.y * across + tile.x];
    let middle = vec2<f32>(pixel) + 0.5;
    var light = vec3(0.0);
    while next != 0u {
        let node = nodes[next - 1u];
        light += node.light * kernel_weight(middle - node.at, node.reach);
        next = node.next;
    }
    return light;
}
