// The star lists, as a picture reads them.
// #import star_list_heads
// #import star_node

@group(2) @binding(0) var<storage, read> list_heads: array<u32>;
@group(2) @binding(1) var nodes: texture_2d<u32>;

// The first node of the list of a group.
fn first_node(group: vec2<u32>) -> u32 {
    // With this bound on the index, a software adapter computes the index for eight pixels at once instead of one
    // by one.
    return list_heads[min(group_head(index_of(group)), arrayLength(&list_heads) - 1u)];
}
