// Light in a direction in which the observer of the row sees it, as the camera sees it, which has a boost relative to
// that observer.
// #import camera
struct Observed {
    direction: vec3<f32>,
    light: vec3<f32>,
}

// The direction is a unit vector. The solid angle of a small image shrinks by the square of the ratio of the
// frequencies.
fn observed(direction: vec3<f32>, light: vec3<f32>) -> Observed {
    let along = dot(direction, camera.motion);
    let across = direction - along * camera.motion;
    let sq = dot(across, across);
    let larger = 1.0 + abs(along);
    let smaller = sq / larger;
    let ahead = select(smaller, larger, along >= 0.0) * camera.doppler;
    let behind = select(larger, smaller, along >= 0.0) / camera.doppler;
    let inverse = 2.0 / (ahead + behind);
    return Observed(
        across * inverse + camera.motion * (0.5 * (ahead - behind) * inverse),
        light * (inverse * inverse),
    );
}
