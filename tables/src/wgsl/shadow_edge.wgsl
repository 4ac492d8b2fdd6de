// The shadow boundary (critical curve) as the observer sees it.
struct ShadowEdge {
    // tan(θ_c/2)/σ.
    tan_half: f32,
    // (5/18) C/σ, the coefficient of (1−X) ln(1−X) relative to that of ln(1−X).
    log_weight: f32,
    // dΔ/dX at X = 0, in the direction away from the hole.
    away_slope: f32,
    // σ; 1 above the horizon, where X = x.
    scale: f32,
}
