// The mean light of the sky over a footprint, by trilinear taps along its longer axis.
// #import arithmetic
// #import footprint
// #import sky

// The mean light of a footprint in the frame of the cube, by at most `most_taps` taps.
fn average(print: Footprint, most_taps: f32) -> vec3<f32> {
    let spread = taps(print, f32(textureDimensions(sky).x), most_taps);
    // From tap to tap the direction turns by the same angle.
    let first = cos_sin(-0.5 * (spread.count - 1.0) * spread.step);
    let step = cos_sin(spread.step);
    var d = print.d * first.x + spread.along * first.y;
    var along = spread.along * first.x - print.d * first.y;
    var sum = vec3(0.0);
    for (var i = 0.0; i < spread.count; i += 1.0) {
        sum += textureSampleLevel(sky, sky_sampler, d, spread.level).rgb;
        let next = d * step.x + along * step.y;
        along = along * step.x - d * step.y;
        d = next;
    }
    return sum / spread.count;
}
