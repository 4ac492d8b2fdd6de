// How far the table's picture and the direct integrator's are apart, amplified.
@compute @workgroup_size(8, 8)
fn difference(@builtin(global_invocation_id) id: vec3<u32>) {
    if !in_tile(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    let by_table = pixel_light(d, p, deflect_lut(-d.z, p));
    let by_steps = pixel_light(d, p, deflect_direct(-d.z, p));
    store(id.xy, vec4(frame.gain * abs(by_table.rgb - by_steps.rgb), 1.0));
}
