// The difference between the pictures by the table and by direct integration, amplified.
// #import deflect_direct
// #import table
// #import region
// #import sky
// #import view

// The difference at pixel `id` of the region.
fn pixel(id: vec2<u32>) -> vec4<f32> {
    let d = view_direction(id);
    let p = length(d.xy);
    let by_table = pixel_light(d, p, deflect_lut(-d.z, p));
    let by_steps = pixel_light(d, p, deflect_direct(-d.z, p));
    return vec4(region.gain * abs(by_table.rgb - by_steps.rgb), 1.0);
}
