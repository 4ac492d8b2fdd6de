// The entry point of a compute pass in which one program draws all pixels of a region.
// #import output
// #import pixel
// #import region

@compute @workgroup_size(TILE, TILE)
fn draw(@builtin(global_invocation_id) id: vec3<u32>) {
    if !in_region(id) {
        return;
    }
    store(id.xy, pixel(id.xy));
}
