// The filtered picture with a disc, by one program for all pixels.
// #import disc_pixel
fn pixel(id: vec2<u32>) -> vec4<f32> {
    return disc_pixel(id);
}
