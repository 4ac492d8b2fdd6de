// The light of the stars that falls on a pixel: the sum of its list, which stars.wgsl has made.

// After the number of nodes, 1 + the index of each pixel's first node, row-major.
@group(2) @binding(0) var<storage, read> heads: array<u32>;
@group(2) @binding(1) var<storage, read> nodes: array<Node>;

fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    var next = heads[1u + pixel.y * frame.size.x + pixel.x];
    var light = vec3(0.0);
    // The end is looked for after each place: a software adapter runs through the loop once more for a look
    // before.
    loop {
        if next != 0u {
            let node = nodes[next - 1u];
            light += light_of(node);
            next = next_of(node);
        }
        if next == 0u {
            break;
        }
    }
    return light;
}
