// The frequency shift of the light of the sky.
// #import camera

// The ratio of the frequencies, camera over observer of the row, of light that this observer sees in the unit direction
// d.
fn doppler_of(d: vec3<f32>) -> f32 {
    let ahead = dot(d, camera.motion);
    return 0.5 * ((1.0 + ahead) * camera.doppler + (1.0 - ahead) / camera.doppler);
}

// ν_obs/ν_∞ of light that the observer of the row sees in the unit direction d.
fn frequency_shift(d: vec3<f32>) -> f32 {
    let redshift = camera.redshifts.x * (1.0 - d.z) + camera.redshifts.y * (1.0 + d.z);
    return doppler_of(d) * 2.0 / redshift;
}
