// View directions and patches of a camera with a boost relative to the observer of the row, as that observer sees them:
// the aberration, a conformal map. Boost of lensbake-core derives the formulae and is the reference in f64.
// #import patch
// #import ray
// #import region

// A unit direction in which the observer of the row sees light, and the factor by which the aberration scales small
// angles there.
struct RowView {
    d: vec3<f32>,
    scale: f32,
}

// The light of the view ray v, which need not be normalised.
fn unboosted(v: vec3<f32>) -> RowView {
    let along = dot(v, camera.motion);
    let across = v - along * camera.motion;
    let sq = dot(across, across);
    let size = sqrt(along * along + sq);
    // The smaller of size ± along is computed from their product, so that it does not cancel.
    let larger = size + abs(along);
    let smaller = sq / larger;
    let forwards = along >= 0.0;
    let ahead = select(smaller, larger, forwards) / camera.doppler;
    let behind = select(larger, smaller, forwards) * camera.doppler;
    let inverse = 1.0 / (ahead + behind);
    return RowView(
        across * (2.0 * inverse) + camera.motion * ((ahead - behind) * inverse),
        2.0 * size * inverse,
    );
}

// The step s of the view ray, as the observer of the row sees it; `scale` is that of the ray. n is the unit vector of
// the ray and `inverse` 1 over its length.
fn unboosted_step(s: vec3<f32>, n: vec3<f32>, inverse: f32, scale: f32) -> vec3<f32> {
    let t = (s - n * dot(n, s)) * inverse;
    let dc = dot(t, camera.motion);
    let c = dot(n, camera.motion);
    let k = camera.doppler;
    let d_scale = 0.5 * scale * scale * (k - 1.0 / k) * dc;
    return (n - camera.motion * c) * d_scale + (t - camera.motion * dc) * scale
        + camera.motion * (scale * scale * dc);
}

fn view_vector(id: vec2<u32>) -> vec3<f32> {
    return direction_at(from_middle(region.first + id));
}

fn view_direction(id: vec2<u32>) -> vec3<f32> {
    return view_vector(id);
}

fn direction_at(at: vec2<f32>) -> vec3<f32> {
    return unboosted(view_ray(at).direction).d;
}

fn patch_at(at: vec2<f32>, side: f32) -> Patch {
    let ray = view_ray(at);
    let v = ray.direction;
    let inverse = inverseSqrt(dot(v, v));
    let n = v * inverse;
    let seen = unboosted(v);
    return patch_of(
        seen.d,
        unboosted_step(ray.right * side, n, inverse, seen.scale),
        unboosted_step(ray.down * side, n, inverse, seen.scale),
    );
}

fn largest_scale(at: vec2<f32>, reach: f32) -> f32 {
    // The scale decreases with the angle α from the motion, so its maximum is at α − reach.
    let n = normalize(view_ray(at).direction);
    let c = dot(n, camera.motion);
    let s = length(n - camera.motion * c);
    let nearest_sin = max(s * cos(reach) - c * sin(reach), 0.0);
    let nearest_cos = select(c * cos(reach) + s * sin(reach), 1.0, nearest_sin == 0.0);
    let larger = 1.0 + abs(nearest_cos);
    let smaller = nearest_sin * nearest_sin / larger;
    let ahead = select(smaller, larger, nearest_cos >= 0.0) / camera.doppler;
    let behind = select(larger, smaller, nearest_cos >= 0.0) * camera.doppler;
    return 2.0 / (ahead + behind);
}
