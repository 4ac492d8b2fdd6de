// What a pixel of 32-bit floats can hold.

// The light that a pixel can hold: all of it.
fn storable(light: vec3<f32>) -> vec3<f32> {
    return light;
}
