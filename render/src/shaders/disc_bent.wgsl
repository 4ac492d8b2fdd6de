// The orbits of the rays that meet a disc, with bending.
// #import camera

// The redshift factors of the observer of the row, in the direction of the hole and straight away.
fn orbit_redshifts() -> vec2<f32> {
    return camera.redshifts;
}

// u = 1/r at the phase ψ (rad) of the ray with 1/b = s, before its periapsis: Weierstrass' ℘ by its Laurent series at ψ/2
// and one duplication. lensbake-core's orbit module derives the formula and is the reference in f64.
fn orbit_inverse_radius(s: f32, phase: f32) -> f32 {
    let sigma = s * phase;
    let phase_sq = phase * phase;
    let w = 0.25 * phase_sq;
    let a = w * w * 0.083333336;
    let c = w * w * (w * 0.0046296297 - sigma * sigma * 0.015625);
    let near = 1.0 + a * 0.05 + c * 0.035714287 + a * (a * 8.333333e-4 + c * 4.8701299e-4);
    let square = near * near + 0.25 * a;
    let p = (square * square + 2.0 * c * near) / (near * (near * near - 0.25 * a) - 0.25 * c);
    let slope = sqrt(max(4.0 * p * p * p - 16.0 * a * p - 64.0 * c, 0.0));
    let above_pole = p + phase_sq * 0.083333336;
    return sigma * (slope + 0.25 * sigma * phase_sq) / (2.0 * above_pole * above_pole);
}
