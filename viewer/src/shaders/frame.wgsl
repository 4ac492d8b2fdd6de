// What a frame needs besides its row; laid out by gpu/frame.rs. All vectors are in the hole frame:
// the camera at the origin, the hole along -Z.
struct Frame {
    // Step of the view direction from one pixel to the next on the right, and below.
    right: vec3<f32>,
    width: u32,
    down: vec3<f32>,
    height: u32,
    forward: vec3<f32>,
    first_row: u32,
    // Columns of the rotation from the hole frame to the sky frame.
    sky_x: vec3<f32>,
    // 1/r of the observer, √(1 − 1/r), and the direct integrator's step in rad.
    u: f32,
    sky_y: vec3<f32>,
    lapse: f32,
    sky_z: vec3<f32>,
    step: f32,
    // tan(θ_c/2) and (5/18) cos θ_c: the members of Edge.
    edge: vec2<f32>,
    // Rows of pixels of this dispatch.
    rows: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
// Row-major [rows][width].
@group(0) @binding(2) var<storage, read_write> output: array<vec4<f32>>;

const CAPTURED: u32 = 0u;
const ESCAPES: u32 = 1u;
const UNFINISHED: u32 = 2u;

// A direction after the hole has turned it: cos and sin of its angle from the hole.
struct Turned {
    fate: u32,
    cos_sky: f32,
    sin_sky: f32,
}

// The unit direction of the middle of a pixel. Twin of Camera::direction.
fn view_direction(column: u32, row: u32) -> vec3<f32> {
    let across = f32(column) + 0.5 - 0.5 * f32(frame.width);
    let along = f32(row) + 0.5 - 0.5 * f32(frame.height);
    return normalize(frame.forward + frame.right * across + frame.down * along);
}

// The direction d turned in its plane through the hole. Twin of Sight::turn.
fn turn_direction(d: vec3<f32>, p: f32, turned: Turned) -> vec3<f32> {
    let scale = turned.sin_sky / max(p, 1e-30);
    return vec3(d.xy * scale, -turned.cos_sky);
}
