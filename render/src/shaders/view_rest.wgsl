// View directions and patches of a camera that is the observer of the row, at rest or in radial motion.
// #import patch
// #import ray
// #import region

// The view direction of the centre of pixel `id` of the region, not normalised.
fn view_vector(id: vec2<u32>) -> vec3<f32> {
    return view_ray(from_middle(region.first + id)).direction;
}

// The same as a unit vector.
fn view_direction(id: vec2<u32>) -> vec3<f32> {
    return normalize(view_vector(id));
}

// The unit view direction at `at`, in pixels from the picture's centre.
fn direction_at(at: vec2<f32>) -> vec3<f32> {
    return normalize(view_ray(at).direction);
}

// The square patch with sides of `side` pixels, centred on `at`, in pixels from the picture's centre.
fn patch_at(at: vec2<f32>, side: f32) -> Patch {
    let ray = view_ray(at);
    return patch_of(ray.direction, ray.right * side, ray.down * side);
}

// Upper bound on the scale of the aberration within `reach` (rad) of the view direction at `at`.
fn largest_scale(at: vec2<f32>, reach: f32) -> f32 {
    return 1.0;
}
