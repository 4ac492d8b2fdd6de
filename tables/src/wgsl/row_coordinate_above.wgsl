// The row coordinate above the horizon: the normalised shadow coordinate x = tan(θ_c/2) / tan(θ/2) of the unit
// direction (cos θ, sin θ) = (c, p), where c ≥ −1 and p ≥ 0. Very large at θ = 0.
fn row_coordinate(c: f32, p: f32, edge: ShadowEdge) -> f32 {
    let cot_half: f32 = select(p / (1.0 - c), (1.0 + c) / max(p, 1e-30), c >= 0.0);
    return edge.tan_half * cot_half;
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
