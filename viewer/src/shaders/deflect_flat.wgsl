// Nobody turns the light: a black sphere before the undeflected sky. Twin of deflect::undeflected.
fn deflect_flat(c: f32, p: f32) -> Turned {
    if c > 0.0 && p < frame.u {
        return Turned(CAPTURED, 0.0, 0.0);
    }
    return Turned(ESCAPES, c, p);
}
