// The light of the stars on a pixel: the sum over the linked list of its group, which list_stars.wgsl has made.
// #import star_list
// #import star_list_heads

@group(2) @binding(0) var<storage, read> list_heads: array<u32>;
@group(2) @binding(1) var nodes: texture_2d<u32>;

fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    let group = group_of(pixel);
    let at = vec2<f32>(pixel - first_pixel(group)) + 0.5;
    // With this bound on the index, a software adapter computes the index for eight pixels at once instead of one
    // by one.
    return list_light(list_heads[min(group_head(index_of(group)), arrayLength(&list_heads) - 1u)], at);
}
