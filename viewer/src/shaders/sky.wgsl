// The light of the sky.

@group(1) @binding(0) var sky: texture_cube<f32>;
@group(1) @binding(1) var sky_sampler: sampler;

fn in_sky_frame(v: vec3<f32>) -> vec3<f32> {
    return frame.sky_x * v.x + frame.sky_y * v.y + frame.sky_z * v.z;
}

// The light from a direction in the hole frame, linear RGB.
fn sky_light(d: vec3<f32>) -> vec3<f32> {
    return textureSampleLevel(sky, sky_sampler, in_sky_frame(d), 0.0).rgb;
}

// The light of a pixel that looks along d, sin θ = p, after the hole has turned it; alpha is the part of
// the pixel that sees the sky.
fn pixel_light(d: vec3<f32>, p: f32, turned: Turned) -> vec4<f32> {
    if turned.fate != ESCAPES {
        return vec4(0.0);
    }
    return vec4(sky_light(turn_direction(d, p, turned)), 1.0);
}
