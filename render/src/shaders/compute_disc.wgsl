// The entry point of a compute pass that draws the tiles in which a disc may be seen, and those beside the shadow's edge.
// #import compute_tiles
// #import disc_pixel

@compute @workgroup_size(TILE, TILE)
fn disc_rays(
    @builtin(num_workgroups) dispatch: vec3<u32>,
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let first = top_of_column(MANY_RAYS, dispatch, workgroup, local);
    var row = 0u;
    loop {
        let id = first + vec2(0u, row);
        if all(id < region.count) {
            store(id, disc_pixel(id));
        }
        row++;
        if row == ROWS {
            break;
        }
    }
}
