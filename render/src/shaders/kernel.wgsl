// Point-spread kernels: how the light of a point is distributed over pixels. stars/kernel.rs is the reference in
// f64; it defines CORE, the half-width of the core in pixels, and HALOS, the number of halos. Kernel 0 is the
// core, kernel k the halo of radius 2ᵏ⁺¹.
// #import constants

// A kernel that puts all light on the pixel with the point at its centre: like a halo of radius 1/2. Its number k
// is −2 in 32 bits, so that 2ᵏ⁺¹ is its radius, too.
const ONE_PIXEL: u32 = 0xfffffffeu;

// The quadratic B-spline in x and y.
fn spline(offset: vec2<f32>) -> vec2<f32> {
    let x = abs(offset);
    let outer = max(CORE - x, vec2(0.0));
    return select(0.5 * outer * outer, 0.75 - x * x, x < vec2(0.5));
}

// The same for four coordinates.
fn splines(offset: vec4<f32>) -> vec4<f32> {
    let x = abs(offset);
    let outer = max(CORE - x, vec4(0.0));
    return select(0.5 * outer * outer, 0.75 - x * x, x < vec4(0.5));
}

// 1/R² of a halo.
fn inverse_square(kernel: u32) -> f32 {
    return bitcast<f32>((125u - 2u * kernel) << 23u);
}

// Half-width of the kernel, pixels.
fn reach_of(kernel: u32) -> f32 {
    return select(f32(2u << kernel), CORE, kernel == 0u);
}

// The fraction of a point's light that falls on a pixel whose centre is `offset` from the point is kernel_factor
// times kernel_share.
fn kernel_factor(kernel: u32) -> f32 {
    return select(2.2281692 * inverse_square(kernel), 1.0, kernel == 0u);
}

fn kernel_share(offset: vec2<f32>, kernel: u32) -> f32 {
    let core = spline(offset);
    let inside = max(1.0 - dot(offset, offset) * inverse_square(kernel), 0.0);
    let cube = inside * inside * inside;
    return select(cube * cube, core.x * core.y, kernel == 0u);
}

// kernel_share for four pixels below each other, whose vertical offsets are `down`.
fn kernel_shares(right: f32, down: vec4<f32>, kernel: u32) -> vec4<f32> {
    let core = spline(vec2(right)).x * splines(down);
    let inside = max(1.0 - (right * right + down * down) * inverse_square(kernel), vec4(0.0));
    let cube = inside * inside * inside;
    return select(cube * cube, core, vec4(kernel == 0u));
}

// The light, in the brightest channel, that a kernel takes before the next kernel takes any.
fn capacity(kernel: u32) -> f32 {
    let middle = kernel_factor(kernel) * kernel_share(vec2(0.0), kernel);
    return select(1.0 / middle, 3e38, kernel == HALOS);
}
