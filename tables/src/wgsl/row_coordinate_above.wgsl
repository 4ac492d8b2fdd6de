// The row coordinate above the horizon: the normalised shadow coordinate x = tan(θ_c/2) / tan(θ/2) of the direction
// (cos θ, sin θ) = (c, p)/√(c² + p²), where p ≥ 0; the vector (c, p) need not be normalised. Very large at θ = 0.
fn row_coordinate(c: f32, p: f32, edge: ShadowEdge) -> f32 {
    let size: f32 = sqrt(c * c + p * p);
    // cot(θ/2), without the cancellation of size − |c|.
    let adjacent: f32 = select(p, size + c, c >= 0.0);
    let opposite: f32 = select(size - c, max(p, 1e-30), c >= 0.0);
    return edge.tan_half * (adjacent / opposite);
}

// dΔ/dθ from dΔ/dx, with dx/dθ = −x/sin θ.
fn by_view_angle(by_x: f32, x: f32, p: f32, edge: ShadowEdge) -> f32 {
    return -by_x * x / max(p, 1e-30);
}

// The position along the row, from d = 1 − x and √x.
fn row_position(d: f32, root: f32) -> f32 {
    return sqrt(d / (1.0 + root));
}

// dx/d position, at the position q.
fn row_position_slope(q: f32, root: f32) -> f32 {
    return -4.0 * q * max(root, 1e-9);
}
