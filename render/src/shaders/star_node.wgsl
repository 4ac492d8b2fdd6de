// The nodes of the linked lists that list_stars.wgsl makes, one texel each: the light of a star image on a group
// of pixels, and the next node. The pixels of a group, GROUP_WIDTH × GROUP_HEIGHT of them, read the same list, so
// that an image takes few nodes. gpu/stars/nodes.rs defines these constants and NODES_PER_ROW, the width of the
// texture.
// #import star_node_constants

struct Node {
    // The light on a pixel is `light` times kernel_share(the pixel's centre - at, kernel).
    light: vec3<f32>,
    // In pixels from the upper left corner of the group.
    at: vec2<f32>,
    kernel: u32,
    // Node 0 is null: its texel is dark.
    next: u32,
}

// The exponent of the light has 8 bits: from 2⁻⁴⁰, below which light loses bits, to 2¹²⁸, the largest of f32.
const LEAST: u32 = 40u;
const EXPONENTS: u32 = LEAST + 128u;
// A coordinate of the image has 20 bits: steps of 2⁻¹³ pixels from 64 pixels before the group.
const STEPS: f32 = 8192.0;
const BEFORE: f32 = 64.0;

fn texel_of(node: u32) -> vec2<u32> {
    return vec2(node % NODES_PER_ROW, node / NODES_PER_ROW);
}

// The group of a pixel.
fn group_of(pixel: vec2<u32>) -> vec2<u32> {
    return pixel / vec2(GROUP_WIDTH, GROUP_HEIGHT);
}

// The pixel in the upper left corner of a group.
fn first_pixel(group: vec2<u32>) -> vec2<u32> {
    return group * vec2(GROUP_WIDTH, GROUP_HEIGHT);
}

// 2 to the power of n - 127, for n from 1 to 254.
fn power(n: u32) -> f32 {
    return bitcast<f32>(n << 23u);
}

// Light is stored to 1 part in 2¹⁶ of its brightest channel: three mantissas of 16 bits and a shared exponent of
// 8.
fn packed(node: Node) -> vec4<u32> {
    let brightest = max(node.light.r, max(node.light.g, node.light.b));
    // The exponent of the next power of 2 above the brightest channel.
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
        // Sign-extended: see ONE_PIXEL.
        bitcast<u32>(bitcast<i32>(texel.x) >> 26u),
        texel.x & 0x3ffffffu,
    );
}
