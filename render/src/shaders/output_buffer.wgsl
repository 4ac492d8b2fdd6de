// Output to a buffer of the region, row-major.
// #import region
@group(0) @binding(3) var<storage, read_write> output: array<vec4<f32>>;

// Stores pixel `id` of the region.
fn store(id: vec2<u32>, pixel: vec4<f32>) {
    output[id.y * region.count.x + id.x] = pixel;
}
