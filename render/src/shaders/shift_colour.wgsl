// Light with the brightness and the colour of its frequency shift g: a black body at g times its temperature. shift.rs
// explains the model and is the reference in f64.
// #import constants
// #import frequency_shift

fn luminance(light: vec3<f32>) -> f32 {
    return dot(light, vec3(0.2126, 0.7152, 0.0722));
}

fn seen_light(light: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let before = luminance(light);
    if !(before > 0.0) {
        return vec3(0.0);
    }
    let g = frequency_shift(d);
    let ratio = max(light.b, DARKEST * before) / max(light.r, DARKEST * before);
    let inverse_temperature = clamp(WHITE_BODY - log(ratio) / BLUE_OVER_RED, HOTTEST, COLDEST);
    let change = inverse_temperature * (1.0 / g - 1.0);
    let shifted = light * vec3(1.0, exp(-GREEN_OVER_RED * change), exp(-BLUE_OVER_RED * change));
    return shifted * (before * g * g * g * g * camera.light_scale / max(luminance(shifted), 1e-30));
}
