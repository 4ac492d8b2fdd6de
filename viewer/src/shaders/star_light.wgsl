// The light of the stars that falls on a pixel: the sum of its list, which stars.wgsl has made.

// After the number of places asked for, the first place of each list, row-major.
@group(2) @binding(0) var<storage, read> heads: array<u32>;
@group(2) @binding(1) var nodes: texture_2d<u32>;

fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    let at = f32(pixel.x) + 0.5;
    var next = heads[1u + pixel.y * lists_a_row() + pixel.x / SHARING];
    var light = vec3(0.0);
    // The end is looked for after each place: a software adapter runs through the loop once more for a look
    // before.
    loop {
        let node = unpacked(textureLoad(nodes, texel_of(next), 0));
        light += node.light * along_row(at - node.at, node.inverse_sq);
        next = node.next;
        if next == 0u {
            break;
        }
    }
    return light;
}
