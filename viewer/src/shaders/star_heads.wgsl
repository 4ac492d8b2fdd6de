// Where the lists of places begin: a buffer of u32 with, in this order,
//     the number of places asked for;
//     for each overflow list whose it is (0: nobody's), where it begins, and its light on each pixel of the group;
//     for each group where its list begins;
//     for two groups each how many places were counted.
// A driver may end a loop that is too long: llvmpipe does after 65,535 turns of all loops of a shader together, and
// others take a GPU for hung. So the list of a group has at most UNCOUNTED + LIST places: the first UNCOUNTED of all
// places, which no one counts, for that takes time in every frame, and LIST more. What else falls on the group goes
// to overflow lists of LIST places. fold_stars.wgsl adds up each of them to the light of the group's pixels, and
// link_stars.wgsl puts that into the list of the group.
// UNCOUNTED, LIST, OVERFLOWS (a power of 2), OVERFLOW_BITS and A_GROUP, the most overflow lists of a group and 1, come from
// gpu/stars/nodes.rs.

const PIXELS: u32 = SHARING_X * SHARING_Y;
const OWNERS: u32 = 1u;
const OVERFLOW_HEADS: u32 = OWNERS + OVERFLOWS;
const FOLDED_LIGHT: u32 = OVERFLOW_HEADS + OVERFLOWS;
const GROUP_HEADS: u32 = FOLDED_LIGHT + 3u * PIXELS * OVERFLOWS;
// Overflow lists that are added up at once.
const AT_ONCE: u32 = OVERFLOWS / 4u;

fn groups_across() -> u32 {
    return (frame.size.x + SHARING_X - 1u) / SHARING_X;
}

fn index_of(group: vec2<u32>) -> u32 {
    return group.y * groups_across() + group.x;
}

// Where the head of the list of a group of this index is.
fn head_of(index: u32) -> u32 {
    return GROUP_HEADS + index;
}

// Where the light of an overflow list on a pixel of its group is: three channels.
fn folded_light(list: u32, pixel: u32) -> u32 {
    return FOLDED_LIGHT + 3u * (list * PIXELS + pixel);
}

// The middle of a pixel of a group, in pixels from the group's upper left corner.
fn middle_of(pixel: u32) -> vec2<f32> {
    return vec2<f32>(vec2(pixel % SHARING_X, pixel / SHARING_X)) + 0.5;
}
