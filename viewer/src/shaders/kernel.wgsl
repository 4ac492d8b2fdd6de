// How the light of a point falls on pixels, row by row. Twins of stars/kernel.rs, which gives CORE, FIRST_HALO
// and LAST_HALO: how far the core reaches, pixels, and the radii of the halos.

// The kernel that reaches as far as `reach`, on a row of pixels: its factor, and what along_row takes.
struct KernelRow {
    factor: f32,
    inverse_sq: f32,
}

// What along_row takes for the core: less than for any halo.
const CORE_ROW: f32 = 0.00048828125;

// The quadratic B-spline.
fn spline(offset: f32) -> f32 {
    let x = abs(offset);
    let outer = max(CORE - x, 0.0);
    return select(0.5 * outer * outer, 0.75 - x * x, x < 0.5);
}

fn sixth_power(x: f32) -> f32 {
    let cube = x * x * x;
    return cube * cube;
}

// The row whose middle is `offset` from the point. A halo's is (1 - s²/R²)⁶ at s² = offset² + x²; with
// ρ² = R² - offset² that is (ρ²/R²)⁶ (1 - x²/ρ²)⁶, of which 1/ρ² is kept.
fn kernel_row(offset: f32, reach: f32) -> KernelRow {
    if reach == CORE {
        return KernelRow(spline(offset), CORE_ROW);
    }
    let inside = max(1.0 - offset * offset / (reach * reach), 0.0);
    return KernelRow(
        2.2281692 / (reach * reach) * sixth_power(inside),
        1.0 / max(reach * reach * inside, 1e-3),
    );
}

// The share of a row's light that falls on a pixel `offset` from the point along the row.
fn along_row(offset: f32, inverse_sq: f32) -> f32 {
    let halo = sixth_power(max(1.0 - offset * offset * inverse_sq, 0.0));
    return select(halo, spline(offset), inverse_sq == CORE_ROW);
}

// The light that the kernel takes before the next does.
fn capacity(reach: f32) -> f32 {
    let row = kernel_row(0.0, reach);
    return select(1.0 / (row.factor * along_row(0.0, row.inverse_sq)), 3e38, reach == LAST_HALO);
}
