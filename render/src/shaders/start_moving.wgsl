// Direct integration from an observer in radial motion, above the horizon or below.
// #import camera

// du/dφ = u (z_in cot(θ/2) − z_out tan(θ/2)) / 2 at the observer, positive towards the hole.
fn start_slope(c: f32, p: f32) -> f32 {
    let z = camera.redshifts;
    return 0.5 * camera.inverse_radius * (z.x * (1.0 + c) - z.y * (1.0 - c)) / max(p, 1e-20);
}

// Whether the ray at (u, du/dφ) is below the horizon and moves inwards.
fn is_captured(y: vec2<f32>) -> bool {
    return y.x >= 1.0 && y.y > 0.0;
}
