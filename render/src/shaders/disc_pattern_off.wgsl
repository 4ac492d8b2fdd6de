// A disc without a pattern.
fn disc_pattern(seen: Patch, orbit: Orbit, crossing: Crossing, u: f32) -> f32 {
    return 1.0;
}
