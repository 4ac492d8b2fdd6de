// A patch of the picture. footprint.rs derives the formulae and is the reference in f64.

// A patch of the picture: the unit view direction of its centre in the hole frame, with cos θ = c and sin θ = p;
// the radial unit vector, along which θ grows, and the tangential one; and the steps across the patch to the right
// and downwards, by their radial and tangential parts, rad.
struct Patch {
    d: vec3<f32>,
    c: f32,
    p: f32,
    radial: vec3<f32>,
    tangential: vec3<f32>,
    right: vec2<f32>,
    down: vec2<f32>,
}

// The patch around `ray` with the sides `right` and `down`. None of the three needs to be normalised.
fn patch_of(ray: vec3<f32>, right: vec3<f32>, down: vec3<f32>) -> Patch {
    let inverse = inverseSqrt(dot(ray, ray));
    let d = ray * inverse;
    let p = length(d.xy);
    let radius = select(vec2(1.0, 0.0), d.xy / p, p > 0.0);
    let radial = vec3(radius * -d.z, p);
    let tangential = vec3(-radius.y, radius.x, 0.0);
    return Patch(
        d, -d.z, p, radial, tangential,
        vec2(dot(right, radial), dot(right, tangential)) * inverse,
        vec2(dot(down, radial), dot(down, tangential)) * inverse,
    );
}

// |dθ| across the patch along the gradient of θ, rad.
fn gradient(seen: Patch) -> f32 {
    return length(vec2(seen.right.x, seen.down.x));
}

// The patch moved by `angle` rad away from the hole, its radial length multiplied by `extent`.
fn moved(seen: Patch, angle: f32, extent: f32) -> Patch {
    return patch_of(
        seen.d + seen.radial * angle,
        seen.radial * (seen.right.x * extent) + seen.tangential * seen.right.y,
        seen.radial * (seen.down.x * extent) + seen.tangential * seen.down.y,
    );
}
