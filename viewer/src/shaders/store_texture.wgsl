// As large as the picture.
@group(0) @binding(2) var output: texture_storage_2d<rgba16float, write>;

// Keeps what the pixel `id` of the tile is.
fn store(id: vec2<u32>, pixel: vec4<f32>) {
    textureStore(output, frame.first + id, pixel);
}
