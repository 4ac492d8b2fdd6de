// The images of a star with bending, by the inverse row. InverseLens::Bent is the reference in f64.
// #import inverse
// #import inverse_lens
fn star_image(sky_angle: f32, p: f32) -> StarImage {
    let seen = image(sky_angle, lens.inverse);
    return StarImage(true, seen.cos_sin, magnification(seen, sky_angle, p));
}

// The fraction of the light of a star that is drawn as points: 1 − arc_share of stars/images.rs. p is the sine of
// the star's distance from the optical axis. The rest is drawn as arcs, which the CPU divides into pieces.
fn point_share(c: f32, p: f32, straight: bool) -> f32 {
    let t = clamp((p - lens.point_distance) / lens.point_distance, 0.0, 1.0);
    return select(t * t * (3.0 - 2.0 * t), 1.0, straight && c < 0.0);
}
