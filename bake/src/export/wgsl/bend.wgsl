// The bending (deflection angle) in rad of the light that is seen at the angle theta from the direction of the hole,
// with cos(theta) = c and sin(theta) = p. It comes from the angle theta - bend. 1e4 if the ray ends in the hole.
fn bend(c: f32, p: f32, edge: ShadowEdge, RADIUS, DATA) -> f32 {
    let x: f32 = row_coordinate(c, p, edge);
    if (x >= 1.0) {
        return 1e4;
    }
    let d: f32 = 1.0 - x;
    let stored: f32 = stored_value(row_position(d, sqrt(x)), RADIUS, DATA);
    return stored - (1.0 + edge.log_weight * d) * log(d);
}
