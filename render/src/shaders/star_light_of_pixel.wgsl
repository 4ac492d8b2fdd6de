// The light of the stars on a pixel: the sum over the linked list of its group, which list_stars.wgsl has made.
// #import star_list
// #import star_lists

fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    let group = group_of(pixel);
    return list_light(first_node(group), vec2<f32>(pixel - first_pixel(group)) + 0.5);
}
