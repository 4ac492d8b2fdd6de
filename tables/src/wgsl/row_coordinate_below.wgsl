// The row coordinate below the horizon, X = x/(x + σ(1−x)), of the direction (cos θ, sin θ) = (c, p)/√(c² + p²), where
// p ≥ 0; the vector (c, p) need not be normalised. It exceeds 1 for all directions in the shadow.
fn row_coordinate(c: f32, p: f32, edge: ShadowEdge) -> f32 {
    let size: f32 = sqrt(c * c + p * p);
    // cot(θ/2) = n/m, so that X = (T/σ) n / (m − (T/σ)(σ−1) n), which has a pole inside the shadow.
    let n: f32 = edge.tan_half * select(p, size + c, c >= 0.0);
    let m: f32 = select(size - c, p, c >= 0.0);
    let below: f32 = m - (edge.scale - 1.0) * n;
    return select(2.0, n / below, n < below);
}

// dΔ/dθ from dΔ/dX, with dX/dθ = −X (1 − X + σX)/sin θ.
fn by_view_angle(by_x: f32, x: f32, p: f32, edge: ShadowEdge) -> f32 {
    return -by_x * x * (1.0 + (edge.scale - 1.0) * x) / max(p, 1e-30);
}

// The position along the row from d = 1 − X and √X: √X = 1 − (7/4) q² + (3/4) q⁴. The texels are in the order of falling
// q, so that the position is 1 − q: straight away, where q is 1 and a pixel covers the least of the sky, rounding q would
// cost most.
fn row_position(d: f32, root: f32) -> f32 {
    let grown: f32 = sqrt(1.0 + 48.0 * root);
    let q: f32 = sqrt(8.0 * d / ((1.0 + root) * (7.0 + grown)));
    // 1 − q² = 8 √X / (1 + √(1 + 48 √X)).
    return 8.0 * root / ((1.0 + grown) * (1.0 + q));
}

// dX/d position, at the position.
fn row_position_slope(position: f32, root: f32) -> f32 {
    let q = 1.0 - position;
    return q * max(root, 1e-9) * (7.0 - 6.0 * q * q);
}
