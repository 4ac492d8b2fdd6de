// Output to a texture of the whole picture.
// #import region
@group(0) @binding(3) var output: texture_storage_2d<rgba16float, write>;

// Stores pixel `id` of the region.
fn store(id: vec2<u32>, pixel: vec4<f32>) {
    textureStore(output, region.first + id, pixel);
}
