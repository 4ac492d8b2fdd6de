// The entry point of a compute pass that draws the tiles in which a disc may be seen, and those beside the shadow's edge.
// #import compute_tiles
// #import disc_pixel

@compute @workgroup_size(TILE, TILE)
fn disc_rays(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let id = queued_pixel(MANY_RAYS, dispatch, workgroup, local);
    if !in_region(id) {
        return;
    }
    store(id.xy, disc_pixel(id.xy));
}
