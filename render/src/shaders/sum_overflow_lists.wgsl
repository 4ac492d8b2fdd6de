// Sums up the overflow lists that list_stars.wgsl has made: one invocation for each pixel of the groups of some
// lists. link_overflow_sums.wgsl inserts the sums into the lists of the groups, in another dispatch, because no
// dispatch may both read and write the nodes.
// #import star_list
// #import star_list_heads

@group(0) @binding(1) var<storage, read_write> list_heads: array<atomic<u32>>;
@group(0) @binding(2) var nodes: texture_2d<u32>;

@compute @workgroup_size(64)
fn sum_overflow_lists(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = id.x % GROUP_PIXELS;
    let middle = middle_of(pixel);
    for (var list = id.x / GROUP_PIXELS; list < OVERFLOWS; list += AT_ONCE) {
        if atomicLoad(&list_heads[OWNERS + list]) != 0u {
            let light = list_light(atomicLoad(&list_heads[OVERFLOW_HEADS + list]), middle);
            let at = overflow_sum(list, pixel);
            atomicStore(&list_heads[at], bitcast<u32>(light.r));
            atomicStore(&list_heads[at + 1u], bitcast<u32>(light.g));
            atomicStore(&list_heads[at + 2u], bitcast<u32>(light.b));
        }
    }
}
