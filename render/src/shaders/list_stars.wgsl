// Inserts the light of the images of the stars into linked lists, which the picture sums up: one invocation for each
// image. stars/draw.rs is the reference in f64.
// #import arithmetic
// #import camera
// #import constants
// #import inverse_lens
// #import insert_light
// #import kernel
// #import observe
// #import shift
// #import star_images

struct Star {
    // In the sky frame.
    direction: vec3<f32>,
    light: vec3<f32>,
}

@group(0) @binding(4) var<storage, read> stars: array<Star>;
// The images that the picture may show: the index of the star in the lower 24 bits, and above them the image
// order.
@group(0) @binding(5) var<storage, read> candidates: array<u32>;

// Distributes the light of a point, which is not dark, over the kernels: kernel::spread is the reference.
fn spread(at: vec2<f32>, light: vec3<f32>) {
    let brightest = max(light.r, max(light.g, light.b));
    var left = brightest;
    var kernel = 0u;
    // The loop tests for its end after each kernel: see star_list.wgsl.
    loop {
        let taken = min(left, capacity(kernel));
        insert(at, kernel, light * (taken / brightest));
        left -= taken;
        kernel++;
        if left <= 0.0 {
            break;
        }
    }
}

// Draws light in a view direction in the hole frame. Camera::project is the reference.
fn show(direction: vec3<f32>, light: vec3<f32>) {
    let ahead = dot(direction, camera.forward);
    if ahead <= 0.0 {
        return;
    }
    let steps = vec2(dot(direction, camera.right), dot(direction, camera.down));
    let squares = vec2(dot(camera.right, camera.right), dot(camera.down, camera.down));
    let at = steps / (ahead * squares) + 0.5 * vec2<f32>(camera.size);
    // Farther out, no kernel reaches the picture.
    if all(abs(at) < vec2(1e5)) {
        spread(at, light);
    }
}

// Draws the image of a star in this image order: twice the number of windings of the light, plus one if the image
// is on the other side of the hole (stars::images::ImageOrder).
fn draw(star: Star, order: u32) {
    let d = in_hole_frame(star.direction);
    let c = -d.z;
    let p = length(d.xy);
    let side = select(1.0, -1.0, (order & 1u) == 1u);
    let sky_angle = side * angle(c, p) - 6.2831855 * f32(order >> 1u);
    let seen = star_image(sky_angle, p);
    let azimuth = d.xy * (side / max(p, 1e-30));
    let direction = vec3(azimuth * seen.cos_sin.y, -seen.cos_sin.x);
    let light = star.light * (point_share(c, p, order == 0u) * seen.magnification);
    let image = observed(direction, seen_light(light, direction));
    if seen.visible && max(image.light.r, max(image.light.g, image.light.b)) >= MIN_LIGHT {
        show(image.direction, image.light);
    }
}

@compute @workgroup_size(64)
fn list_stars(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < lens.candidates {
        let candidate = candidates[id.x];
        draw(stars[candidate & 0xffffffu], candidate >> 24u);
    }
}
