// Direct integration for footprints. In f32 it finds no slope; that of the row is accurate enough for the size of
// a footprint.
// #import deflect_direct
// #import deflect_lut
fn deflect_direct_patch(c: f32, p: f32) -> Deflected {
    var deflected = deflect_direct(c, p);
    deflected.slope = bending_for_footprint(c, p, shadow_edge()).slope;
    return deflected;
}
