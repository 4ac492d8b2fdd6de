// Presents the finished picture in the window: scaled to the window's pixels, tone-mapped and encoded in sRGB. If
// the picture is enlarged, the shadow's edge can be redrawn at the window's resolution.
// #import camera
// #import full_screen
// #import patch
// #import ray_perspective
// #import shadow
// #import srgb
// #import tone_map

// How the picture is scaled to the window. Each value has its own pipeline, because a driver may compile a shader
// again for every value of a uniform that it branches on.
override FIT: u32;
const UNSCALED: u32 = 0u;
const FROM_TWO_BY_TWO: u32 = 1u;
const ENLARGED: u32 = 2u;
const ENLARGED_EDGE: u32 = 3u;
// Whether the shader must encode sRGB because the window's format does not.
override ENCODE: bool;

struct Present {
    // Width and height of the picture, in its own pixels.
    picture: vec2<u32>,
    // Column of the divider, in pixels of the window; beyond the window if there is no divider.
    divider: u32,
    // In stops.
    exposure: f32,
}

// Binding 0, `camera`, is the camera of the window at the window's own resolution.
@group(0) @binding(1) var<uniform> present: Present;
// Linear RGB, premultiplied by alpha, the part of the pixel that sees the sky.
@group(0) @binding(2) var picture: texture_2d<f32>;

fn texel(at: vec2<i32>) -> vec4<f32> {
    return textureLoad(picture, clamp(at, vec2(0), vec2<i32>(present.picture) - 1), 0);
}

// The part of a pixel of the window that sees the sky, from the distance of its centre from the shadow's edge in
// pixels.
fn reads_sky(pixel: vec2<u32>) -> f32 {
    let ray = view_ray(from_middle(pixel));
    let seen = patch_of(ray.direction, ray.right, ray.down);
    let distance = shadow_distance(seen.c, seen.p, half_shadow());
    return clamp(0.5 + distance / max(gradient(seen), 1e-12), 0.0, 1.0);
}

// Bilinear interpolation between the four nearest pixels.
fn enlarged(pixel: vec2<u32>, ratio: vec2<f32>) -> vec3<f32> {
    let at = (vec2<f32>(pixel) + 0.5) * ratio - 0.5;
    let base = floor(at);
    let t = at - base;
    let first = vec2<i32>(base);
    let top = mix(texel(first), texel(first + vec2(1, 0)), t.x);
    let bottom = mix(texel(first + vec2(0, 1)), texel(first + vec2(1, 1)), t.x);
    let mean = mix(top, bottom, t.y);
    if FIT == ENLARGED {
        return mean.rgb;
    }
    // The light of the sky alone, not darkened by the shadow beside it, times the part of the window's pixel that
    // sees the sky.
    return mean.rgb / max(mean.a, 1e-4) * reads_sky(pixel);
}

fn light(pixel: vec2<u32>) -> vec3<f32> {
    if FIT == UNSCALED {
        return texel(vec2<i32>(pixel)).rgb;
    }
    if FIT == FROM_TWO_BY_TWO {
        let first = vec2<i32>(2u * pixel);
        return 0.25 * (texel(first) + texel(first + vec2(1, 0)) + texel(first + vec2(0, 1))
            + texel(first + vec2(1, 1))).rgb;
    }
    return enlarged(pixel, vec2<f32>(present.picture) / vec2<f32>(camera.size));
}

@fragment
fn shade(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>(position.xy);
    var shown = tone_map(light(pixel), present.exposure);
    shown = select(shown, vec3(1.0, 0.6, 0.1), pixel.x == present.divider);
    if ENCODE {
        shown = srgb_from_linear(shown);
    }
    return vec4(shown, 1.0);
}
