// Inserts the sums of the overflow lists, which sum_overflow_lists.wgsl has made, into the lists of their groups:
// one node for each pixel, from the nodes that are reserved for the sums.
// #import kernel
// #import star_list_heads
// #import star_node

@group(0) @binding(1) var<storage, read_write> list_heads: array<atomic<u32>>;
@group(0) @binding(2) var nodes: texture_storage_2d<rgba32uint, write>;

fn light_at(at: u32) -> f32 {
    return bitcast<f32>(atomicLoad(&list_heads[at]));
}

@compute @workgroup_size(64)
fn link_overflow_sums(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = id.x % GROUP_PIXELS;
    for (var list = id.x / GROUP_PIXELS; list < OVERFLOWS; list += AT_ONCE) {
        let owner = atomicLoad(&list_heads[OWNERS + list]);
        if owner != 0u {
            let at = overflow_sum(list, pixel);
            let light = vec3(light_at(at), light_at(at + 1u), light_at(at + 2u));
            let node = CAPACITY + list * GROUP_PIXELS + pixel;
            let head = group_head(owner / OVERFLOWS_PER_GROUP - 1u);
            let next = atomicExchange(&list_heads[head], node);
            let entry = Node(light, middle_of(pixel), ONE_PIXEL, next);
            textureStore(nodes, texel_of(node), packed(entry));
        }
    }
}
