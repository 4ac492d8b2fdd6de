// The direction on the sky from which the light comes that is seen in the direction d; hole is the direction of the hole.
// All are unit vectors in any one frame. (0, 0, 0) if the ray ends in the hole.
fn lensed(d: vec3<f32>, hole: vec3<f32>, OBSERVER, DATA) -> vec3<f32> {
    // (x, y, z) is the part of d across the direction of the hole, found from the difference of the two directions, which
    // is exact where they are close: the shadow of a distant hole is small.
    let side: f32 = select(-1.0, 1.0, d.x * hole.x + d.y * hole.y + d.z * hole.z >= 0.0);
    let off_x: f32 = d.x - side * hole.x;
    let off_y: f32 = d.y - side * hole.y;
    let off_z: f32 = d.z - side * hole.z;
    let along: f32 = off_x * hole.x + off_y * hole.y + off_z * hole.z;
    let x: f32 = off_x - along * hole.x;
    let y: f32 = off_y - along * hole.y;
    let z: f32 = off_z - along * hole.z;
    let p: f32 = sqrt(x * x + y * y + z * z);
    let c: f32 = side + along;
    let angle: f32 = bend(c, p, shadow_edge(OBSERVER), RADIUS, DATA);
    if (angle > 1e3) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    let sky: vec2<f32> = turned(c, p, angle);
    let across: f32 = sky.y / max(p, 1e-30);
    return vec3<f32>(
        sky.x * hole.x + across * x,
        sky.x * hole.y + across * y,
        sky.x * hole.z + across * z
    );
}
