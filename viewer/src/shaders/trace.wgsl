// Where each pixel's light comes from: the direction in the hole frame, and the fate.
@compute @workgroup_size(8, 8)
fn trace(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= frame.width || id.y >= frame.rows {
        return;
    }
    let d = view_direction(id.x, frame.first_row + id.y);
    let p = length(d.xy);
    let turned = deflect(-d.z, p);
    output[id.y * frame.width + id.x] = vec4(turn_direction(d, p, turned), f32(turned.fate));
}
