// The places of the lists that stars.wgsl makes, a texel each: the light of an image along a row of pixels, and
// the next place. A list is of SHARING pixels side by side: they go through it together, and an image takes few
// places. SHARING, PLACES_A_ROW (texels) and PLACES come from gpu/stars/nodes.rs.

struct Node {
    // What falls on a pixel is `light` by along_row(distance of the pixel's middle from `at`, inverse_sq).
    light: vec3<f32>,
    // In pixels from the picture's left border.
    at: f32,
    inverse_sq: f32,
    // 0 for none: the texel of place 0 is dark.
    next: u32,
}

// Of the least exponent: light of less than 2⁻⁴⁰ is lost, and 2²³ is the most.
const LEAST: u32 = 40u;

// The bits of 2⁻¹¹ without the last 12.
const SHORTEST: u32 = 0x3a000u;

fn texel_of(place: u32) -> vec2<u32> {
    return vec2(place % PLACES_A_ROW, place / PLACES_A_ROW);
}

// Lists to a row of pixels.
fn lists_a_row() -> u32 {
    return (frame.size.x + SHARING - 1u) / SHARING;
}

// 2 to the power of n - 127, for n from 1 to 254.
fn power(n: u32) -> f32 {
    return bitcast<f32>(n << 23u);
}

// A float from 2⁻¹¹ to 2²¹ in 16 bits, to 1 part in 4096; 2⁻¹¹ itself exactly.
fn shortened(x: f32) -> u32 {
    return min(((bitcast<u32>(x) + 0x800u) >> 12u) - SHORTEST, 0xffffu);
}

fn lengthened(bits: u32) -> f32 {
    return bitcast<f32>((bits + SHORTEST) << 12u);
}

// Light keeps 1 part in 2¹⁷ of its brightest channel: three mantissas of 16 bits and an exponent of 6.
fn packed(node: Node) -> vec4<u32> {
    let brightest = max(node.light.r, max(node.light.g, node.light.b));
    // Of the power of 2 next above it.
    let exponent = clamp((bitcast<u32>(brightest) >> 23u) + LEAST, 126u, 189u) - 126u;
    let scaled = node.light * power(127u + 16u + LEAST - exponent);
    let mantissa = vec3<u32>(min(scaled + 0.5, vec3(65535.0)));
    return vec4(
        node.next | (exponent << 26u),
        bitcast<u32>(node.at),
        mantissa.r | (mantissa.g << 16u),
        mantissa.b | (shortened(node.inverse_sq) << 16u),
    );
}

fn unpacked(texel: vec4<u32>) -> Node {
    let mantissa = vec3(texel.z & 0xffffu, texel.z >> 16u, texel.w & 0xffffu);
    return Node(
        vec3<f32>(mantissa) * power(127u + (texel.x >> 26u) - LEAST - 16u),
        bitcast<f32>(texel.y),
        lengthened(texel.w >> 16u),
        texel.x & 0x3ffffffu,
    );
}
