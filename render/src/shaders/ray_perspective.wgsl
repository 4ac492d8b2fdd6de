// View rays of a picture in perspective. camera/projection.rs is the reference in f64.
// #import camera

// The view ray at a point in pixels from the picture's centre.
fn view_ray(at: vec2<f32>) -> ViewRay {
    return ViewRay(camera.forward + camera.right * at.x + camera.down * at.y, camera.right, camera.down);
}

// Upper bound on the angle between the rays of neighbouring pixels within `reach` pixels of a point. It is largest at
// the centre of the picture and decreases outwards.
fn largest_pixel(at: vec2<f32>, reach: f32) -> f32 {
    let step = length(camera.right);
    let nearest = step * max(length(at) - reach, 0.0);
    return step * inverseSqrt(nearest * nearest + 1.0);
}
