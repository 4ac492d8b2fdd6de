// The light of the sky.
// #import camera
// #import deflection
// #import shift

@group(1) @binding(0) var sky: texture_cube<f32>;
@group(1) @binding(1) var sky_sampler: sampler;

// The light from a direction in the hole frame, which need not be normalised, linear RGB.
fn sky_light(d: vec3<f32>) -> vec3<f32> {
    return textureSampleLevel(sky, sky_sampler, in_sky_frame(d), 0.0).rgb;
}

// The light of a pixel with the view direction d, which need not be normalised, at the distance p from the axis, after
// deflection. Alpha is the part of the pixel that sees the sky.
fn pixel_light(d: vec3<f32>, p: f32, deflected: Deflected) -> vec4<f32> {
    if deflected.outcome != ESCAPES {
        return vec4(0.0);
    }
    return vec4(seen_light(sky_light(turn_direction(d, p, deflected)), normalize(d)), 1.0);
}
