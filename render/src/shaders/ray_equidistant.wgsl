// View rays of an equidistant fisheye picture. camera/projection.rs is the reference in f64.
// #import arithmetic
// #import camera

// The view ray at a point in pixels from the picture's centre.
fn view_ray(at: vec2<f32>) -> ViewRay {
    let pixel = length(camera.right);
    let right = camera.right / pixel;
    let down = camera.down / pixel;
    let distance = length(at);
    let outward = select(vec2(1.0, 0.0), at / distance, distance > 0.0);
    let from_centre = right * outward.x + down * outward.y;
    let around = down * outward.x - right * outward.y;
    let angle = pixel * distance;
    let turned = cos_sin(angle);
    let radial = (from_centre * turned.x - camera.forward * turned.y) * pixel;
    // The step around the centre is shorter by sin α / α.
    let tangential = around * (select(1.0, turned.y / angle, angle > 1e-3) * pixel);
    return ViewRay(
        camera.forward * turned.x + from_centre * turned.y,
        radial * outward.x - tangential * outward.y,
        radial * outward.y + tangential * outward.x,
    );
}

// Upper bound on the angle between the rays of neighbouring pixels.
fn largest_pixel(at: vec2<f32>, reach: f32) -> f32 {
    return length(camera.right);
}
