// The picture: the light of each pixel, linear RGB.

@group(1) @binding(0) var sky: texture_cube<f32>;
@group(1) @binding(1) var sky_sampler: sampler;

// The light from a direction in the hole frame.
fn sky_light(d: vec3<f32>) -> vec3<f32> {
    let in_sky = frame.sky_x * d.x + frame.sky_y * d.y + frame.sky_z * d.z;
    return textureSampleLevel(sky, sky_sampler, in_sky, 0.0).rgb;
}

@compute @workgroup_size(8, 8)
fn picture(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= frame.width || id.y >= frame.rows {
        return;
    }
    let d = view_direction(id.x, frame.first_row + id.y);
    let p = length(d.xy);
    let turned = deflect(-d.z, p);
    var light = vec3(0.0);
    if turned.fate == ESCAPES {
        light = sky_light(turn_direction(d, p, turned));
    }
    output[id.y * frame.width + id.x] = vec4(light, 1.0);
}
