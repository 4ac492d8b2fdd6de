// The image of a star without bending: a black sphere in front of the undeflected sky. InverseLens::Flat is the
// reference in f64.
// #import arithmetic
// #import camera
// #import inverse_lens
fn star_image(sky_angle: f32, p: f32) -> StarImage {
    let t = cos_sin(sky_angle);
    let visible = sky_angle > 0.0 && (t.x <= 0.0 || p >= camera.inverse_radius);
    return StarImage(visible, vec2(t.x, p), 1.0);
}

fn point_share(c: f32, p: f32, straight: bool) -> f32 {
    return 1.0;
}
