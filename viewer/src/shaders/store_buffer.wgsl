// Row-major, as wide as the tile.
@group(0) @binding(2) var<storage, read_write> output: array<vec4<f32>>;

// Keeps what the pixel `id` of the tile is.
fn store(id: vec2<u32>, pixel: vec4<f32>) {
    output[id.y * frame.count.x + id.x] = pixel;
}

// The light that a pixel can keep: all.
fn storable(light: vec3<f32>) -> vec3<f32> {
    return light;
}
