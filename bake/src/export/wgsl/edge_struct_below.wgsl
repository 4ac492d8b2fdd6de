// The edge of the shadow (critical curve), as an observer sees it at the angle theta_c from the direction of the hole.
struct ShadowEdge {
    // tan(theta_c/2)/sigma.
    tan_half: f32,
    // (5/18) C/sigma, where C is the cosine of theta_c for an observer at rest, continued below the horizon.
    log_weight: f32,
    // sigma, which is 1 above the horizon.
    scale: f32,
}
