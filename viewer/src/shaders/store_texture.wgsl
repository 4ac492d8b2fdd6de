// As large as the picture.
@group(0) @binding(2) var output: texture_storage_2d<rgba16float, write>;

// Keeps what the pixel `id` of the tile is.
fn store(id: vec2<u32>, pixel: vec4<f32>) {
    textureStore(output, frame.first + id, pixel);
}

// The light that a pixel can keep: a 16-bit float ends at 65504, and what is infinite is black on the screen. From
// 2¹⁵ on, 32768 times white, it is halved until it is less, all channels alike: it stays the colour that it is.
// By integers, for a software adapter takes longer over the larger of two floats.
fn storable(light: vec3<f32>) -> vec3<f32> {
    let bits = bitcast<vec3<i32>>(light);
    let brightest = max(max(bits.r, bits.g), max(bits.b, 141 << 23u));
    // 2¹⁴ over the power of 2 in the brightest channel, or 1.
    return light * bitcast<f32>((268u << 23u) - (bitcast<u32>(brightest) & 0x7f800000u));
}
