// Adds up the overflow lists that stars.wgsl has made: one invocation a pixel of the groups of some lists. What comes
// of it is put into the groups' own lists by link_stars.wgsl: no dispatch both reads and writes the places.

@group(0) @binding(1) var<storage, read_write> heads: array<atomic<u32>>;
@group(0) @binding(2) var nodes: texture_2d<u32>;

@compute @workgroup_size(64)
fn fold_stars(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = id.x % PIXELS;
    let middle = middle_of(pixel);
    for (var list = id.x / PIXELS; list < OVERFLOWS; list += AT_ONCE) {
        if atomicLoad(&heads[OWNERS + list]) != 0u {
            let light = list_light(atomicLoad(&heads[OVERFLOW_HEADS + list]), middle);
            let at = folded_light(list, pixel);
            atomicStore(&heads[at], bitcast<u32>(light.r));
            atomicStore(&heads[at + 1u], bitcast<u32>(light.g));
            atomicStore(&heads[at + 2u], bitcast<u32>(light.b));
        }
    }
}
