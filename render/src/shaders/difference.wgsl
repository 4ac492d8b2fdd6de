// The difference between the pictures by the table and by direct integration, amplified.
// #import deflect_direct
// #import deflect_lut
// #import output
// #import region
// #import sky
// #import view
@compute @workgroup_size(TILE, TILE)
fn difference(@builtin(global_invocation_id) id: vec3<u32>) {
    if !in_region(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    let by_table = pixel_light(d, p, deflect_lut(-d.z, p));
    let by_steps = pixel_light(d, p, deflect_direct(-d.z, p));
    store(id.xy, vec4(region.gain * abs(by_table.rgb - by_steps.rgb), 1.0));
}
