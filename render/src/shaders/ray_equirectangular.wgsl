// View rays of an equirectangular picture. camera/projection.rs is the reference in f64.
// #import arithmetic
// #import camera

// The view ray at a point in pixels from the picture's centre.
fn view_ray(at: vec2<f32>) -> ViewRay {
    let pixel = length(camera.right);
    let right = camera.right / pixel;
    let down = camera.down / pixel;
    let longitude = cos_sin(pixel * at.x);
    let latitude = cos_sin(pixel * at.y);
    let on_equator = camera.forward * longitude.x + right * longitude.y;
    let along = right * longitude.x - camera.forward * longitude.y;
    return ViewRay(
        on_equator * latitude.x + down * latitude.y,
        along * (pixel * latitude.x),
        (down * latitude.x - on_equator * latitude.y) * pixel,
    );
}

// Upper bound on the angle between the rays of neighbouring pixels.
fn largest_pixel(at: vec2<f32>, reach: f32) -> f32 {
    return length(camera.right);
}
