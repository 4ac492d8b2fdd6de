// The table turns the light. Twin of deflect::look_up.
fn deflect_lut(c: f32, p: f32) -> Turned {
    let bent = bending(c, p, Edge(frame.edge.x, frame.edge.y, frame.away_slope));
    if bent.captured {
        return Turned(CAPTURED, 0.0, 0.0, 0.0);
    }
    let sky = turned(c, p, bent.bend);
    return Turned(ESCAPES, sky.x, sky.y, bent.slope);
}
