// The finished picture on the screen: enlarged or reduced to the window's pixels and encoded in sRGB.
// Where the picture is enlarged, the shadow's edge is drawn anew at the window's own resolution.

// How the picture becomes the window's: a pipeline each, for a driver may compile a shader anew for every
// value of a uniform that it branches by.
override FIT: u32;
const AS_IT_IS: u32 = 0u;
const FROM_TWO_BY_TWO: u32 = 1u;
const ENLARGED: u32 = 2u;
const ENLARGED_SHADOW: u32 = 3u;
const ENLARGED_SPHERE: u32 = 4u;
// Whether the window's format leaves it to the shader to encode sRGB.
override ENCODE: bool;

struct Present {
    // Width and height of the picture, its own pixels.
    picture: vec2<u32>,
    // Column of the window's pixels in which the divider stands; beyond the window for none.
    divider: u32,
    // In stops.
    exposure: f32,
}

// The window as a picture of its own.
@group(0) @binding(1) var<uniform> present: Present;
// Linear RGB times the part of the pixel that sees the sky, and that part.
@group(0) @binding(2) var picture: texture_2d<f32>;

@vertex
fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    // One triangle that covers the window.
    return vec4(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn texel(at: vec2<i32>) -> vec4<f32> {
    return textureLoad(picture, clamp(at, vec2(0), vec2<i32>(present.picture) - 1), 0);
}

// The part of the window's pixel that sees the sky: by the angle between its middle and the edge.
fn sees_sky(pixel: vec2<u32>) -> f32 {
    let from_middle = vec2<f32>(pixel) + 0.5 - 0.5 * vec2<f32>(frame.size);
    let ray = frame.forward + frame.right * from_middle.x + frame.down * from_middle.y;
    let d = normalize(ray);
    let c = -d.z;
    let p = length(d.xy);
    // The angle from the edge outwards, rad, near the edge.
    var outwards = 0.0;
    if FIT == ENLARGED_SPHERE {
        outwards = select(10.0, (p - frame.u) / max(frame.lapse, 1e-6), c > 0.0);
    } else {
        let x = edge_coordinate(c, p, Edge(frame.edge.x, frame.edge.y, frame.away_slope));
        outwards = (1.0 - x) * p / max(x, 1e-6);
    }
    // How much the angle from the hole grows from pixel to pixel.
    let away = vec3(d.xy * (c / max(p, 1e-30)), p);
    let grows = length(vec2(dot(frame.right, away), dot(frame.down, away))) / length(ray);
    return clamp(0.5 + outwards / max(grows, 1e-12), 0.0, 1.0);
}

// The four pixels about a place, by their nearness.
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
    // The light of the sky alone, not darkened by the shadow beside it.
    return mean.rgb / max(mean.a, 1e-4) * sees_sky(pixel);
}

fn light(pixel: vec2<u32>) -> vec3<f32> {
    if FIT == AS_IT_IS {
        return texel(vec2<i32>(pixel)).rgb;
    }
    if FIT == FROM_TWO_BY_TWO {
        let first = vec2<i32>(2u * pixel);
        return 0.25 * (texel(first) + texel(first + vec2(1, 0)) + texel(first + vec2(0, 1))
            + texel(first + vec2(1, 1))).rgb;
    }
    return enlarged(pixel, vec2<f32>(present.picture) / vec2<f32>(frame.size));
}

// The sRGB transfer function (IEC 61966-2-1). Twin of picture::srgb_from_linear.
fn srgb_from_linear(linear: vec3<f32>) -> vec3<f32> {
    let clamped = clamp(linear, vec3(0.0), vec3(1.0));
    let curved = 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055;
    return select(curved, 12.92 * clamped, clamped <= vec3(0.0031308));
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
