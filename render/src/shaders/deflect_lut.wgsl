// Deflection by table lookup, in a row of stereographic coordinates.
// #import camera_edge
// #import deflection
// #import stereographic

// For one ray, whose vector (c, p) need not be normalised; nor is (cos_sky, sin_sky). The derivative needs a unit vector.
fn deflect_lut(c: f32, p: f32) -> Deflected {
    let sky = sky_direction(c, p, shadow_edge());
    if sky.captured {
        return Deflected(CAPTURED, 0.0, 0.0, 0.0);
    }
    return Deflected(ESCAPES, sky.cos_sin.x, sky.cos_sin.y, sky.radial);
}

// For footprints: (cos_sky, sin_sky) is a unit vector.
fn deflect_lut_patch(c: f32, p: f32) -> Deflected {
    var deflected = deflect_lut(c, p);
    if deflected.outcome == ESCAPES {
        let size = inverseSqrt(deflected.cos_sky * deflected.cos_sky + deflected.sin_sky * deflected.sin_sky);
        deflected.cos_sky *= size;
        deflected.sin_sky *= size;
    }
    return deflected;
}
