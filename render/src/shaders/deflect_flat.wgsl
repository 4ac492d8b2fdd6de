// No deflection: a black sphere in front of the undeflected sky.
// #import camera
// #import deflection
fn deflect_flat(c: f32, p: f32) -> Deflected {
    if c > 0.0 && p * p < camera.inverse_radius * camera.inverse_radius * (c * c + p * p) {
        return Deflected(CAPTURED, 0.0, 0.0, 0.0);
    }
    return Deflected(ESCAPES, c, p, 1.0);
}
