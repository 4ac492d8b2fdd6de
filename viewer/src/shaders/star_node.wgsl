// A place in the list of a pixel: light that falls on the pixel, and the next place. Packed into 64 bits, for a
// picture is the slower by every word that it reads: 22 bits for the next place, a mantissa of 12 bits a
// channel and an exponent of 6 that they share. So the light keeps 1 part in 8192 of its brightest channel.

struct Node {
    low: u32,
    high: u32,
}

// The bits of the next place. 0 is none, so there are as many places.
const PLACE: u32 = 0x3fffffu;
// Of the least exponent: light of less than 2⁻⁴⁰ is lost, and 2²³ is the most.
const LEAST: u32 = 40u;

// 2 to the power of n - 127, for n from 1 to 254.
fn power(n: u32) -> f32 {
    return bitcast<f32>(n << 23u);
}

// `light` before the place `next`.
fn packed(light: vec3<f32>, next: u32) -> Node {
    let brightest = max(light.r, max(light.g, light.b));
    // Of the power of 2 next above it.
    let exponent = clamp((bitcast<u32>(brightest) >> 23u) + LEAST, 126u, 189u) - 126u;
    let scaled = light * power(127u + 12u + LEAST - exponent);
    let mantissa = vec3<u32>(min(scaled + 0.5, vec3(4095.0)));
    return Node(
        next | (mantissa.r << 22u),
        (mantissa.r >> 10u) | (mantissa.g << 2u) | (mantissa.b << 14u) | (exponent << 26u),
    );
}

fn next_of(node: Node) -> u32 {
    return node.low & PLACE;
}

fn light_of(node: Node) -> vec3<f32> {
    let red = (node.low >> 22u) | ((node.high & 3u) << 10u);
    let mantissa = vec3(red, (node.high >> 2u) & 0xfffu, (node.high >> 14u) & 0xfffu);
    return vec3<f32>(mantissa) * power(127u + (node.high >> 26u) - LEAST - 12u);
}
