// How the light of a point falls on pixels. Twins of stars/kernel.rs, which gives CORE, how far the core
// reaches, pixels, and HALOS, how many there are. Kernel 0 is the core, k the halo of radius 2ᵏ⁺¹.

// Light that falls on the one pixel in whose middle it is, all of it: like a halo of radius 1/2, −2 in 32 bits.
const ONE_PIXEL: u32 = 0xfffffffeu;

// The quadratic B-spline, in either direction.
fn spline(offset: vec2<f32>) -> vec2<f32> {
    let x = abs(offset);
    let outer = max(CORE - x, vec2(0.0));
    return select(0.5 * outer * outer, 0.75 - x * x, x < vec2(0.5));
}

// 1/R² of a halo.
fn inverse_square(kernel: u32) -> f32 {
    return bitcast<f32>((125u - 2u * kernel) << 23u);
}

fn reach_of(kernel: u32) -> f32 {
    return select(f32(2u << kernel), CORE, kernel == 0u);
}

// The share of a point's light that falls on a pixel whose middle is `offset` from it is the factor times
// the kernel_share.
fn kernel_factor(kernel: u32) -> f32 {
    return select(2.2281692 * inverse_square(kernel), 1.0, kernel == 0u);
}

fn kernel_share(offset: vec2<f32>, kernel: u32) -> f32 {
    let core = spline(offset);
    let inside = max(1.0 - dot(offset, offset) * inverse_square(kernel), 0.0);
    let cube = inside * inside * inside;
    return select(cube * cube, core.x * core.y, kernel == 0u);
}

// The light that the kernel takes before the next does.
fn capacity(kernel: u32) -> f32 {
    let middle = kernel_factor(kernel) * kernel_share(vec2(0.0), kernel);
    return select(1.0 / middle, 3e38, kernel == HALOS);
}
