// The hole bends the light: the image by the inverse row. Twin of Lens::Bent.
fn star_image(sky_angle: f32, p: f32) -> StarImage {
    let seen = image(sky_angle, lens.inverse);
    return StarImage(true, seen.cos_sin, magnification(seen, sky_angle, p));
}

// The part of its light with which a star at the sine p from the axis is drawn as points: the rest is drawn
// as arcs, which the CPU takes to pieces. 1 less the twin of arc_share.
fn point_share(c: f32, p: f32, straight: bool) -> f32 {
    let t = clamp((p - lens.point_distance) / lens.point_distance, 0.0, 1.0);
    return select(t * t * (3.0 - 2.0 * t), 1.0, straight && c < 0.0);
}
