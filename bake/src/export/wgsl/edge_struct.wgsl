// The edge of the shadow (critical curve), as an observer sees it at the angle theta_c from the direction of the hole.
struct ShadowEdge {
    // tan(theta_c/2).
    tan_half: f32,
    // (5/18) cos(theta_c).
    log_weight: f32,
}
