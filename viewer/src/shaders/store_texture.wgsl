// As large as the picture.
@group(0) @binding(2) var output: texture_storage_2d<rgba16float, write>;

// The most that a 16-bit float holds. What is more would be infinite, and the screen black there.
const MOST: f32 = 65504.0;

// Keeps what the pixel `id` of the tile is.
fn store(id: vec2<u32>, pixel: vec4<f32>) {
    let brightest = max(pixel.r, max(pixel.g, pixel.b));
    // All channels by the same factor: it stays the colour that it is.
    let kept = vec4(pixel.rgb * (MOST / max(brightest, MOST)), pixel.a);
    textureStore(output, frame.first + id, kept);
}
