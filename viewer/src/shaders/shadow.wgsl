// The shadow as a disc. Twin of shadow.rs.

// The part of a patch of the picture that sees the sky: its share of the area, its middle from the
// patch's middle away from the hole, and its length along the radius, in sides of the patch.
struct SkyPart {
    covered: f32,
    shift: f32,
    extent: f32,
}

// 2 sin((θ − θ_c)/2) of a direction with cos θ = c and sin θ = p, from the cos and sin of θ_c/2.
fn shadow_distance(c: f32, p: f32, half_edge: vec2<f32>) -> f32 {
    // cos and sin of θ/2, without the cancellation of √(1 − |cos θ|).
    let greater = sqrt(0.5 + 0.5 * abs(c));
    let lesser = 0.5 * p / greater;
    let half = select(vec2(lesser, greater), vec2(greater, lesser), c >= 0.0);
    return 2.0 * (half.y * half_edge.x - half.x * half_edge.y);
}

// The part of a patch of the width px whose middle has this distance from the edge, both in rad.
fn sky_part(distance: f32, px: f32, half_edge: vec2<f32>) -> SkyPart {
    let radius = 2.0 * min(half_edge.x, half_edge.y) / px;
    // A disc of diameter 2R has a mean width of πR/2 across the radius.
    let width = min(1.5707964 * radius, 1.0);
    let edge = -distance / px;
    let near = clamp(edge, -0.5, 0.5);
    if half_edge.y > half_edge.x {
        // The sky is a window.
        let far = clamp(edge + 2.0 * radius, -0.5, 0.5);
        return SkyPart((far - near) * width, 0.5 * (far + near), far - near);
    }
    let far = clamp(edge - 2.0 * radius, -0.5, 0.5);
    return SkyPart(1.0 - (near - far) * width, 0.5 * (0.5 + near), 0.5 - near);
}
