// What a pixel of 16-bit floats can hold.

// The light that a pixel can hold. A 16-bit float ends at 65504, and infinite light would be black on the screen.
// Light of 2¹⁵ or more, 32768 times white, is halved in all channels until it is less, so that its colour stays
// the same. The comparison is in integers, because a software adapter takes longer to compare floats.
fn storable(light: vec3<f32>) -> vec3<f32> {
    let bits = bitcast<vec3<i32>>(light);
    let brightest = max(max(bits.r, bits.g), max(bits.b, 141 << 23u));
    // The factor is 2¹⁴ divided by the power of 2 in the brightest channel, or 1.
    return light * bitcast<f32>((268u << 23u) - (bitcast<u32>(brightest) & 0x7f800000u));
}
