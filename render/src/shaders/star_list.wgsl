// The sum over a linked list of star images.
// #import kernel
// #import star_node

// The light of the list that begins with node `first`, on the pixel whose centre is `at`, in pixels from the upper
// left corner of its group.
fn list_light(first: u32, at: vec2<f32>) -> vec3<f32> {
    var next = first;
    var light = vec3(0.0);
    // The loop tests for the end after each node: if it tested before, a software adapter would run one more
    // iteration.
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
