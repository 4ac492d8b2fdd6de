// The heads of the linked lists of star images: a buffer of u32 that holds, in this order,
//     the number of requested nodes;
//     for the overflow lists: their owners (0: free), their heads, and their light on each pixel of the group;
//     for each group: the head of its list; each row of groups is padded to a multiple of LISTS_ALIGNMENT heads, so
//         that it can be copied to a texture;
//     for each pair of groups: the number of their nodes that were counted.
// A driver may end a loop that is too long: llvmpipe ends it after 65,535 iterations of all loops of a shader
// together, and other drivers take the GPU for hung. Therefore the list of a group has at most UNCOUNTED + LIST
// nodes: the first UNCOUNTED nodes of the picture, which are not counted group by group because that takes time in
// every frame, and LIST more. Further light on the group goes to overflow lists of LIST nodes.
// sum_overflow_lists.wgsl sums up each of them to the light of the group's pixels, and link_overflow_sums.wgsl
// inserts the sums into the list of the group.
// gpu/stars/nodes.rs defines LISTS_ALIGNMENT, UNCOUNTED, LIST, OVERFLOWS (a power of 2), OVERFLOW_BITS, and OVERFLOWS_PER_GROUP, one
// more than the number of overflow lists that a group can have.
// #import camera
// #import star_node_constants

const GROUP_PIXELS: u32 = GROUP_WIDTH * GROUP_HEIGHT;
const OWNERS: u32 = 1u;
const OVERFLOW_HEADS: u32 = OWNERS + OVERFLOWS;
const OVERFLOW_SUMS: u32 = OVERFLOW_HEADS + OVERFLOWS;
const GROUP_HEADS: u32 = OVERFLOW_SUMS + 3u * GROUP_PIXELS * OVERFLOWS;
// Number of overflow lists that are summed up at the same time.
const AT_ONCE: u32 = OVERFLOWS / 4u;

// Number of heads in a row of groups, with those that pad it.
fn lists_across() -> u32 {
    let groups = (camera.size.x + GROUP_WIDTH - 1u) / GROUP_WIDTH;
    return (groups + LISTS_ALIGNMENT - 1u) / LISTS_ALIGNMENT * LISTS_ALIGNMENT;
}

fn index_of(group: vec2<u32>) -> u32 {
    return group.y * lists_across() + group.x;
}

// Index of the head of a group's list.
fn group_head(index: u32) -> u32 {
    return GROUP_HEADS + index;
}

// Index of the light of an overflow list on a pixel of its group, which has three channels.
fn overflow_sum(list: u32, pixel: u32) -> u32 {
    return OVERFLOW_SUMS + 3u * (list * GROUP_PIXELS + pixel);
}

// The centre of a pixel of a group, in pixels from the group's upper left corner.
fn middle_of(pixel: u32) -> vec2<f32> {
    return vec2<f32>(vec2(pixel % GROUP_WIDTH, pixel / GROUP_WIDTH)) + 0.5;
}
