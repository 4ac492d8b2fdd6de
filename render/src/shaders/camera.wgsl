// The camera: the view direction of each pixel. gpu/camera_block.rs has the same struct. All vectors are in the
// hole frame: the camera at the origin, the hole along −Z.
struct Camera {
    // Step of the view direction in the picture's centre from one pixel to the next on the right, and 1/r of the
    // observer.
    right: vec3<f32>,
    inverse_radius: f32,
    // The same from one pixel to the next below, and √(1 − 1/r).
    down: vec3<f32>,
    lapse: f32,
    // View direction of the picture's centre, and ShadowEdge.away_slope.
    forward: vec3<f32>,
    away_slope: f32,
    // Columns of the rotation from the hole frame to the sky frame. Beside them, cos and sin of half the shadow's
    // angular radius as the deflection method draws it, and tan(θ_c/2).
    sky_x: vec3<f32>,
    half_shadow_cos: f32,
    sky_y: vec3<f32>,
    half_shadow_sin: f32,
    sky_z: vec3<f32>,
    tan_half_shadow: f32,
    // Width and height of the picture, pixels.
    size: vec2<u32>,
    // ShadowEdge.log_weight: (5/18) C/σ, and ShadowEdge.scale: σ.
    log_weight: f32,
    edge_scale: f32,
    // Unit vector of the boost relative to the observer of the row, and its Doppler factor √((1+β)/(1−β)): 0 and 1
    // without one.
    motion: vec3<f32>,
    doppler: f32,
    // Redshift factors ν_∞/ν_obs of the observer of the row, in the direction of the hole and straight away.
    redshifts: vec2<f32>,
    // Factor of all light with a frequency shift: Rendition.light_scale.
    light_scale: f32,
}

@group(0) @binding(0) var<uniform> camera: Camera;

// The centre of a pixel of the picture, in pixels from the picture's centre.
fn from_middle(pixel: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(pixel) + 0.5 - 0.5 * vec2<f32>(camera.size);
}

// The view ray at a point of the picture, not normalised, and its change from one pixel to the next on the right and below.
struct ViewRay {
    direction: vec3<f32>,
    right: vec3<f32>,
    down: vec3<f32>,
}

fn in_sky_frame(v: vec3<f32>) -> vec3<f32> {
    return camera.sky_x * v.x + camera.sky_y * v.y + camera.sky_z * v.z;
}

fn in_hole_frame(v: vec3<f32>) -> vec3<f32> {
    return vec3(dot(camera.sky_x, v), dot(camera.sky_y, v), dot(camera.sky_z, v));
}

// cos and sin of half the shadow's angular radius.
fn half_shadow() -> vec2<f32> {
    return vec2(camera.half_shadow_cos, camera.half_shadow_sin);
}
