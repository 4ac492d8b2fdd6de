// The shadow's edge as the tables need it.
// #import camera
// #import shadow_edge

fn shadow_edge() -> ShadowEdge {
    return ShadowEdge(camera.tan_half_shadow, camera.log_weight, camera.away_slope, camera.edge_scale);
}
