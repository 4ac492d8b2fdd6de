// Direct integration for footprints. In f32 it finds no derivative; that of the row is accurate enough for the
// size of a footprint.
// #import deflect_direct
// #import table
fn deflect_direct_patch(c: f32, p: f32) -> Deflected {
    var deflected = deflect_direct(c, p);
    deflected.radial = deflect_lut_patch(c, p).radial;
    return deflected;
}
