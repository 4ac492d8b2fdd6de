// The light of one ray.
// #import deflect
// #import sky

// The light in the view direction d, which need not be normalised: only its direction counts in all of this, and a cube
// map is sampled by any vector.
fn ray_light(d: vec3<f32>) -> vec4<f32> {
    let p = length(d.xy);
    return pixel_light(d, p, deflect(-d.z, p));
}
