// Light in a direction in which the observer of the row sees it, as the camera sees it, which is that observer.
struct Observed {
    direction: vec3<f32>,
    light: vec3<f32>,
}

fn observed(direction: vec3<f32>, light: vec3<f32>) -> Observed {
    return Observed(direction, light);
}
