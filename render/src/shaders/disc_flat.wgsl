// The orbits of the rays that meet a disc, without bending: straight lines.
// #import arithmetic

fn orbit_redshifts() -> vec2<f32> {
    return vec2(1.0);
}

fn orbit_inverse_radius(s: f32, phase: f32) -> f32 {
    return s * cos_sin(phase).y;
}
