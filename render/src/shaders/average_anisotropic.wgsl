// The mean light of the sky over a footprint, by the anisotropic filter of the hardware: one fetch with the steps
// across the footprint as its gradients.
// #import footprint
// #import sky

// The mean light of a footprint in the frame of the cube. The sampler, not `most_taps`, bounds the number of taps.
fn average(print: Footprint, most_taps: f32) -> vec3<f32> {
    return textureSampleGrad(sky, sky_sampler, print.d, print.right, print.down).rgb;
}

// The same: that filter finds its level itself.
fn first_level_average(print: Footprint) -> vec3<f32> {
    return average(print, MAX_TAPS);
}
