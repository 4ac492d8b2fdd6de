// The light of the stars that falls on a pixel: the sum of its group's list, which stars.wgsl has made.

@group(2) @binding(0) var<storage, read> heads: array<u32>;
@group(2) @binding(1) var nodes: texture_2d<u32>;

fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    let group = group_of(pixel);
    let at = vec2<f32>(pixel - first_pixel(group)) + 0.5;
    // Bounded, so that a software adapter finds the index for eight pixels at once and not one by one.
    var next = heads[min(head_of(group), arrayLength(&heads) - 1u)];
    var light = vec3(0.0);
    // The end is looked for after each place: a software adapter runs through the loop once more for a look
    // before.
    loop {
        let node = unpacked(textureLoad(nodes, texel_of(next), 0));
        light += node.light * kernel_share(at - node.at, node.kernel);
        next = node.next;
        if next == 0u {
            break;
        }
    }
    return light;
}
