// The light of the stars that falls on a pixel: the sum of its group's list, which stars.wgsl has made.

@group(2) @binding(0) var<storage, read> heads: array<u32>;
@group(2) @binding(1) var nodes: texture_2d<u32>;

fn star_light(pixel: vec2<u32>) -> vec3<f32> {
    let group = group_of(pixel);
    let at = vec2<f32>(pixel - first_pixel(group)) + 0.5;
    // Bounded, so that a software adapter finds the index for eight pixels at once and not one by one.
    return list_light(heads[min(head_of(index_of(group)), arrayLength(&heads) - 1u)], at);
}
