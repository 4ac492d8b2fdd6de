// The picture.
@compute @workgroup_size(8, 8)
fn picture(@builtin(global_invocation_id) id: vec3<u32>) {
    if !in_tile(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    keep(id.xy, pixel_light(d, p, deflect(-d.z, p)));
}
