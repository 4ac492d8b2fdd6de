// The entry points of a render pass that draws a region: one triangle over the whole target, of which the scissor
// rectangle leaves the region.
// #import full_screen
// #import origin
// #import pixel

@fragment
fn draw(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return pixel(vec2<u32>(position.xy) - origin());
}
