// The shadow as a disc. shadow.rs derives the formulae and is the reference in f64.

// The part of a patch of the picture that sees the sky: the fraction of the patch's area, the distance of its
// centre from the patch's centre, away from the hole, and its radial length, in sides of the patch.
struct SkyPart {
    covered: f32,
    shift: f32,
    extent: f32,
}

// The distance from the shadow's edge, 2 sin((θ − θ_c)/2), of a direction with cos θ = c and sin θ = p, from the
// cos and sin of θ_c/2.
fn shadow_distance(c: f32, p: f32, half_shadow: vec2<f32>) -> f32 {
    // cos and sin of θ/2, without the cancellation of √(1 − |cos θ|).
    let greater = sqrt(0.5 + 0.5 * abs(c));
    let lesser = 0.5 * p / greater;
    let half = select(vec2(lesser, greater), vec2(greater, lesser), c >= 0.0);
    return 2.0 * (half.y * half_shadow.x - half.x * half_shadow.y);
}

// The part of a patch that sees the sky. px is the width of the patch, `distance` the distance of its centre from
// the shadow's edge, both in rad.
fn sky_part(distance: f32, px: f32, half_shadow: vec2<f32>) -> SkyPart {
    let radius = 2.0 * min(half_shadow.x, half_shadow.y) / px;
    // A disc of diameter 2R has a mean width of πR/2 across the radius.
    let width = min(1.5707964 * radius, 1.0);
    let edge = -distance / px;
    let near = clamp(edge, -0.5, 0.5);
    if half_shadow.y > half_shadow.x {
        // Below the photon sphere the sky is the smaller disc.
        let far = clamp(edge + 2.0 * radius, -0.5, 0.5);
        return SkyPart((far - near) * width, 0.5 * (far + near), far - near);
    }
    let far = clamp(edge - 2.0 * radius, -0.5, 0.5);
    return SkyPart(1.0 - (near - far) * width, 0.5 * (0.5 + near), 0.5 - near);
}
