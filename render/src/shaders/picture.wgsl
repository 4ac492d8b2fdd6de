// The picture, one ray per pixel.
// #import deflect
// #import keep
// #import region
// #import sky
// #import view
@compute @workgroup_size(TILE, TILE)
fn picture(@builtin(global_invocation_id) id: vec3<u32>) {
    if !in_region(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    keep(id.xy, pixel_light(d, p, deflect(-d.z, p)));
}
