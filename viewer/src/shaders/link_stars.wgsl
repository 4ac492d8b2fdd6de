// Puts the sums of the overflow lists, which fold_stars.wgsl has made, into the lists of their groups: a place a pixel,
// of those that are kept for it.

@group(0) @binding(1) var<storage, read_write> heads: array<atomic<u32>>;
@group(0) @binding(2) var nodes: texture_storage_2d<rgba32uint, write>;

fn light_at(at: u32) -> f32 {
    return bitcast<f32>(atomicLoad(&heads[at]));
}

@compute @workgroup_size(64)
fn link_stars(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = id.x % PIXELS;
    for (var list = id.x / PIXELS; list < OVERFLOWS; list += AT_ONCE) {
        let owner = atomicLoad(&heads[OWNERS + list]);
        if owner != 0u {
            let at = folded_light(list, pixel);
            let light = vec3(light_at(at), light_at(at + 1u), light_at(at + 2u));
            let place = ROOM + list * PIXELS + pixel;
            let next = atomicExchange(&heads[head_of(owner / A_GROUP - 1u)], place);
            let node = Node(light, middle_of(pixel), ONE_PIXEL, next);
            textureStore(nodes, texel_of(place), packed(node));
        }
    }
}
