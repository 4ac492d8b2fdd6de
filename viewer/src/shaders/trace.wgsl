// Where each pixel's light comes from: the direction in the hole frame, and the fate.
@compute @workgroup_size(8, 8)
fn trace(@builtin(global_invocation_id) id: vec3<u32>) {
    if !in_tile(id) {
        return;
    }
    let d = view_direction(id.xy);
    let p = length(d.xy);
    let turned = deflect(-d.z, p);
    store(id.xy, vec4(turn_direction(d, p, turned), f32(turned.fate)));
}
