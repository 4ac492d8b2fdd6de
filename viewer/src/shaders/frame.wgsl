// What a frame needs besides its row; laid out by gpu/frame.rs. All vectors are in the hole frame:
// the camera at the origin, the hole along -Z.
struct Frame {
    // Step of the view direction from one pixel to the next on the right, and 1/r of the observer.
    right: vec3<f32>,
    u: f32,
    // The same from one pixel to the next below, and √(1 − 1/r).
    down: vec3<f32>,
    lapse: f32,
    // View direction of the picture's middle. A difference is amplified by gain.
    forward: vec3<f32>,
    gain: f32,
    // Columns of the rotation from the hole frame to the sky frame, and the third member of Edge.
    sky_x: vec3<f32>,
    away_slope: f32,
    sky_y: vec3<f32>,
    // cos and sin of half the angle of the shadow's edge as the method draws it.
    half_edge_cos: f32,
    sky_z: vec3<f32>,
    half_edge_sin: f32,
    // tan(θ_c/2) and (5/18) cos θ_c: the first members of Edge.
    edge: vec2<f32>,
    // Width and height of the picture, pixels.
    size: vec2<u32>,
    // The tile that this dispatch draws: its first pixel, its width and height.
    first: vec2<u32>,
    count: vec2<u32>,
    // Index of the first of this tile's lists of blocks, and of its first block.
    lists: u32,
    blocks: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;

const CAPTURED: u32 = 0u;
const ESCAPES: u32 = 1u;
const UNFINISHED: u32 = 2u;

// A direction after the hole has turned it: cos and sin of its angle from the hole, and dΔ/dθ.
struct Turned {
    fate: u32,
    cos_sky: f32,
    sin_sky: f32,
    slope: f32,
}

// Whether the dispatch's invocation `id` has a pixel in the tile.
fn in_tile(id: vec3<u32>) -> bool {
    return all(id.xy < frame.count);
}

// The unit direction of the middle of the pixel `id` of the tile. Twin of Camera::direction.
fn view_direction(id: vec2<u32>) -> vec3<f32> {
    let from_middle = vec2<f32>(frame.first + id) + 0.5 - 0.5 * vec2<f32>(frame.size);
    return normalize(frame.forward + frame.right * from_middle.x + frame.down * from_middle.y);
}

// The direction d turned in its plane through the hole. Twin of Sight::turn.
fn turn_direction(d: vec3<f32>, p: f32, turned: Turned) -> vec3<f32> {
    let scale = turned.sin_sky / max(p, 1e-30);
    return vec3(d.xy * scale, -turned.cos_sky);
}
