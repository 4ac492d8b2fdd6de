// The star lists, as a picture reads them.
// #import star_node

// The head of the list of each group. A software adapter reads a texture in half the time of a buffer.
@group(2) @binding(0) var list_heads: texture_2d<u32>;
@group(2) @binding(1) var nodes: texture_2d<u32>;

// The first node of the list of a group.
fn first_node(group: vec2<u32>) -> u32 {
    return textureLoad(list_heads, group, 0).x;
}
