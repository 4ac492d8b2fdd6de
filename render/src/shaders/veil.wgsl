// The light of the sky and the disc in a pixel, premultiplied by its alpha, and the share of the light of stars that gets through
// the disc.
struct Veil {
    light: vec4<f32>,
    through: f32,
}
