// The light of the list that begins with the place `first` on the pixel whose middle is `at`, in pixels from the
// upper left corner of its group.
fn list_light(first: u32, at: vec2<f32>) -> vec3<f32> {
    var next = first;
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
