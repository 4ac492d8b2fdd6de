// The edge of the shadow that the observer of this row sees.
fn shadow_edge() -> ShadowEdge {
    var edge: ShadowEdge;
    edge.tan_half = TAN_HALF;
    edge.log_weight = LOG_WEIGHT;
    edge.scale = EDGE_SCALE;
    return edge;
}
