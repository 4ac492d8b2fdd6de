// Deflection by table lookup in the row itself: the least models, and the charts. deflect_lut.wgsl has the same functions.
// #import camera_edge
// #import deflection
// #import lookup

// For one ray, whose vector (c, p) need not be normalised: (cos_sky, sin_sky) has its length. The derivative needs a unit
// vector.
fn deflect_lut(c: f32, p: f32) -> Deflected {
    return deflected_by(c, p, bending(c, p, shadow_edge()));
}

// For footprints: the derivative is accurate in every direction, even straight away from the hole.
fn deflect_lut_patch(c: f32, p: f32) -> Deflected {
    return deflected_by(c, p, bending_for_footprint(c, p, shadow_edge()));
}

fn deflected_by(c: f32, p: f32, bent: Bending) -> Deflected {
    if bent.captured {
        return Deflected(CAPTURED, 0.0, 0.0, 0.0);
    }
    let sky = turned(c, p, bent.bend);
    return Deflected(ESCAPES, sky.x, sky.y, 1.0 - bent.slope);
}
