// Direct integration from an observer in radial motion, above the horizon or below.
// #import camera

// du/dφ = u (z_in cot(θ/2) − z_out tan(θ/2)) / 2 at the observer, positive towards the hole. Below the horizon, light whose
// redshift factor z_in cos²(θ/2) + z_out sin²(θ/2) is not positive does not come from this sky: its path leads to that of
// the other exterior of the Kruskal extension. A large slope counts as captured.
fn start_slope(c: f32, p: f32) -> f32 {
    let size = sqrt(c * c + p * p);
    let inwards = camera.redshifts.x * (size + c);
    let outwards = camera.redshifts.y * (size - c);
    let slope = 0.5 * camera.inverse_radius * (inwards - outwards) / max(p, 1e-20);
    return select(1e9, slope, inwards + outwards > 0.0);
}

// Whether the ray at (u, du/dφ) is below the horizon and moves inwards.
fn is_captured(y: vec2<f32>) -> bool {
    return y.x >= 1.0 && y.y > 0.0;
}
