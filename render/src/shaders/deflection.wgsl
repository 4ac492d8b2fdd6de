// The ray outcome, and the direction on the sky after deflection.

const CAPTURED: u32 = 0u;
const ESCAPES: u32 = 1u;
const UNFINISHED: u32 = 2u;

struct Deflected {
    outcome: u32,
    // cos and sin of the sky angle from the direction of the hole, up to a factor; for footprints they are exact.
    cos_sky: f32,
    sin_sky: f32,
    // dθ′/dθ.
    radial: f32,
}

// The direction d after deflection: turned in its plane through the hole. p is the distance of d from the axis, sin θ of
// a unit vector. It has the length of (cos_sky, sin_sky).
fn turn_direction(d: vec3<f32>, p: f32, deflected: Deflected) -> vec3<f32> {
    let scale = deflected.sin_sky / max(p, 1e-30);
    return vec3(d.xy * scale, -deflected.cos_sky);
}
