// The mean light of the sky over a footprint, by taps along its longer axis.
// #import arithmetic
// #import footprint
// #import sky

// The mean light of a footprint in the frame of the cube, by at most `most_taps` trilinear taps.
fn average(print: Footprint, most_taps: f32) -> vec3<f32> {
    let spread = taps(print, f32(textureDimensions(sky).x), most_taps);
    // From tap to tap the direction turns by the same angle.
    let first = cos_sin(-0.5 * (spread.count - 1.0) * spread.step);
    let step = cos_sin(spread.step);
    var d = print.d * first.x + spread.along * first.y;
    var along = spread.along * first.x - print.d * first.y;
    var sum = vec3(0.0);
    var left = spread.count;
    loop {
        sum += textureSampleLevel(sky, sky_sampler, d, spread.level).rgb;
        let next = d * step.x + along * step.y;
        along = along * step.x - d * step.y;
        d = next;
        left -= 1.0;
        if left < 0.5 {
            break;
        }
    }
    return sum / spread.count;
}

// The same for a footprint whose taps are all in the first level. They reach so little of the sky that their great circle
// is a straight line.
fn first_level_average(print: Footprint) -> vec3<f32> {
    let row = first_level_taps(print, f32(textureDimensions(sky).x));
    var d = print.d - row.step * (0.5 * (row.count - 1.0));
    var sum = vec3(0.0);
    var left = row.count;
    loop {
        sum += textureSampleLevel(sky, sky_sampler, d, 0.0).rgb;
        d += row.step;
        left -= 1.0;
        if left < 0.5 {
            break;
        }
    }
    return sum / row.count;
}
