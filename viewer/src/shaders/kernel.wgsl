// How the light of a point falls on pixels. Twins of stars/kernel.rs, which gives CORE, FIRST_HALO and
// LAST_HALO: how far the core reaches, pixels, and the radii of the halos.

// The quadratic B-spline, in either direction.
fn spline(offset: vec2<f32>) -> vec2<f32> {
    let x = abs(offset);
    let outer = max(CORE - x, vec2(0.0));
    return select(0.5 * outer * outer, 0.75 - x * x, x < vec2(0.5));
}

// The share of a point's light that falls on a pixel whose middle is `offset` from it.
fn kernel_weight(offset: vec2<f32>, reach: f32) -> f32 {
    if reach == CORE {
        let share = spline(offset);
        return share.x * share.y;
    }
    let inside = max(1.0 - dot(offset, offset) / (reach * reach), 0.0);
    let cube = inside * inside * inside;
    return 2.2281692 / (reach * reach) * cube * cube;
}

// The light that the kernel takes before the next does.
fn capacity(reach: f32) -> f32 {
    return select(1.0 / kernel_weight(vec2(0.0), reach), 3e38, reach == LAST_HALO);
}
