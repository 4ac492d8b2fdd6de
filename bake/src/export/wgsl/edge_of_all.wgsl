// The edge of the shadow that the observer at rest at r > 1 sees. It depends on r alone, not on the pixel.
fn shadow_edge(OBSERVER) -> ShadowEdge {
    let u: f32 = 1.0 / r;
    let cosine: f32 = 2.598076211 * (0.6666666667 - u) * sqrt(0.3333333333 + u);
    let sine: f32 = 2.598076211 * u * sqrt(max((r - 1.0) / r, 0.0));
    var edge: ShadowEdge;
    edge.tan_half = select((1.0 - cosine) / max(sine, 1e-30), sine / (1.0 + cosine), cosine >= 0.0);
    edge.log_weight = 0.2777777778 * cosine;
    return edge;
}
