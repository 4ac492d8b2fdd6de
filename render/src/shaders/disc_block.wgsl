// The disc of matter around the hole. gpu/disc_block.rs has the same struct.
struct Disc {
    // Unit vector of its axis in the hole frame, and its opacity.
    axis: vec3<f32>,
    opacity: f32,
    // u = 1/r of the inner rim, and the least 1/b² of a ray that reaches it; the same of the outer rim.
    inner_u: f32,
    inner_least: f32,
    outer_u: f32,
    outer_least: f32,
    // Coefficients of the phases at which rays reach the rims: of the inner rim, of the outer, and of the circle on which the
    // observer is, if he is beyond the inner rim.
    phases: array<vec4<f32>, 9>,
    // Factor of Page and Thorne's flux as `disc_flux` computes it: the luminance.
    luminance: f32,
    // The flux relative to the greatest is this factor times that flux.
    relative: f32,
    // 1/K at the hottest place.
    inverse_kelvin: f32,
    // 1 where the frequency shift changes the brightness, and the colour; else 0.
    shifts_brightness: f32,
    shifts_colour: f32,
    // Contrast of its pattern, and the unit vector towards its azimuth 0 in the hole frame.
    contrast: f32,
    node: vec3<f32>,
    // Of the two layers of the pattern: their ages, their weights, and what their noise begins with.
    ages: vec2<f32>,
    weights: vec2<f32>,
    seeds: vec2<u32>,
}
