// The places of the lists that stars.wgsl makes, a texel each: the light of an image on a group of pixels, and
// the next place. A group is of SHARING_X × SHARING_Y pixels: they go through its list together, and an image
// takes few places. These, PLACES_A_ROW (texels) and PLACES come from gpu/stars/nodes.rs.

struct Node {
    // What falls on a pixel is `light` by kernel_share(the pixel's middle - at, kernel).
    light: vec3<f32>,
    // In pixels from the upper left corner of the group.
    at: vec2<f32>,
    kernel: u32,
    // 0 for none: the texel of place 0 is dark.
    next: u32,
}

// The exponents of the light, in 8 bits: from 2⁻⁴⁰, below which light is lost, to 2¹²⁸, the most that f32 holds.
const LEAST: u32 = 40u;
const EXPONENTS: u32 = LEAST + 128u;
// Where an image is, in 20 bits: steps of 2⁻¹³ pixels from 64 pixels before the group.
const STEPS: f32 = 8192.0;
const BEFORE: f32 = 64.0;

fn texel_of(place: u32) -> vec2<u32> {
    return vec2(place % PLACES_A_ROW, place / PLACES_A_ROW);
}

// The group of a pixel.
fn group_of(pixel: vec2<u32>) -> vec2<u32> {
    return pixel / vec2(SHARING_X, SHARING_Y);
}

// The pixel in the upper left corner of a group.
fn first_pixel(group: vec2<u32>) -> vec2<u32> {
    return group * vec2(SHARING_X, SHARING_Y);
}

// 2 to the power of n - 127, for n from 1 to 254.
fn power(n: u32) -> f32 {
    return bitcast<f32>(n << 23u);
}

// Light keeps 1 part in 2¹⁷ of its brightest channel: three mantissas of 16 bits and an exponent of 8.
fn packed(node: Node) -> vec4<u32> {
    let brightest = max(node.light.r, max(node.light.g, node.light.b));
    // Of the power of 2 next above it.
    let exponent = clamp((bitcast<u32>(brightest) >> 23u) + LEAST, 126u, 126u + EXPONENTS) - 126u;
    let scaled = node.light * power(127u + 16u + LEAST - exponent);
    let mantissa = vec3<u32>(min(scaled + 0.5, vec3(65535.0)));
    let at = vec2<u32>((node.at + BEFORE) * STEPS + 0.5);
    return vec4(
        node.next | (node.kernel << 26u),
        mantissa.r | (mantissa.g << 16u),
        mantissa.b | ((at.y >> 12u) << 16u) | (exponent << 24u),
        at.x | (at.y << 20u),
    );
}

fn unpacked(texel: vec4<u32>) -> Node {
    let mantissa = vec3(texel.y & 0xffffu, texel.y >> 16u, texel.z & 0xffffu);
    let at = vec2(texel.w & 0xfffffu, (texel.w >> 20u) | ((texel.z & 0xff0000u) >> 4u));
    return Node(
        vec3<f32>(mantissa) * power(127u + (texel.z >> 24u) - LEAST - 16u),
        vec2<f32>(at) * (1.0 / STEPS) - BEFORE,
        // With its sign: see ONE_PIXEL.
        bitcast<u32>(bitcast<i32>(texel.x) >> 26u),
        texel.x & 0x3ffffffu,
    );
}
