// Direct integration from an observer at rest.
// #import camera

// du/dφ = u √(1−u) cot θ at the observer, positive towards the hole.
fn start_slope(c: f32, p: f32) -> f32 {
    return camera.inverse_radius * camera.lapse * c / max(p, 1e-20);
}

// Whether the ray at (u, du/dφ) has reached the horizon.
fn is_captured(y: vec2<f32>) -> bool {
    return y.x >= 1.0;
}
