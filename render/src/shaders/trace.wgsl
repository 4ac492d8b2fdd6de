// The trace: where the light of each pixel comes from, as a direction on the sky in the hole frame, and the ray
// outcome.
// #import deflect
// #import output
// #import region
// #import view
@compute @workgroup_size(TILE, TILE)
fn trace(@builtin(global_invocation_id) id: vec3<u32>) {
    if !in_region(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    let deflected = deflect(-d.z, p);
    store(id.xy, vec4(turn_direction(d, p, deflected), f32(deflected.outcome)));
}
