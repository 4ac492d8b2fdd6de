//! Mirrors of the WGSL functions of the lookup: Rust functions in f32 with the same names and the same operations.
//! The results of a device agree with these up to rounding; `tests/tests/mirrors/` checks this on every adapter.

use crate::interpolation::{chord, cubic, horner};
use crate::lookup::{GpuRow, HorizonSide, ShadowEdge};
use crate::row_format::coefficients;
use crate::{Interpolation, RowFormat};
use lensbake_core::RayOutcome;

/// Bound on sin θ and X. If both are below it and cos θ < 0, the ray looks straight away from the hole and Δ is
/// `away_slope`·X, with a relative error of 1e-6.
pub const STRAIGHT_AWAY: f32 = 1e-3;

/// The bending as a GPU computes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bending {
    /// Δ, the deflection angle, rad.
    pub bend: f32,
    /// dΔ/dθ, the derivative along the view angle.
    pub slope: f32,
}

/// The row coordinate X = x/(x + σ(1−x)) of the direction (cos θ, sin θ) = (`c`, `p`)/√(c² + p²), where `p` ≥ 0; the vector
/// (`c`, `p`) need not be normalised. Above the horizon it is the normalised shadow coordinate x = tan(θ_c/2) / tan(θ/2), very large at θ = 0.
pub fn row_coordinate(c: f32, p: f32, edge: ShadowEdge, side: HorizonSide) -> f32 {
    let size = (c * c + p * p).sqrt();
    let (adjacent, opposite) = if c >= 0.0 {
        (size + c, p)
    } else {
        (p, size - c)
    };
    match side {
        HorizonSide::Above => edge.tan_half * (adjacent / opposite.max(1e-30)),
        HorizonSide::Below => {
            let (n, m) = (edge.tan_half * adjacent, opposite);
            let below = m - (edge.scale - 1.0) * n;
            if n < below { n / below } else { 2.0 }
        }
    }
}

/// dΔ/dθ from dΔ/dX (`by_x`), at the row coordinate `x` and sin θ = `p`.
pub fn by_view_angle(by_x: f32, x: f32, p: f32, edge: ShadowEdge, side: HorizonSide) -> f32 {
    match side {
        HorizonSide::Above => -by_x * x / p.max(1e-30),
        HorizonSide::Below => -by_x * x * (1.0 + (edge.scale - 1.0) * x) / p.max(1e-30),
    }
}

/// The position along the row, from `d` = 1 − X and `root` = √X: q above the horizon, 1 − q below, where the texels are in
/// the order of falling q.
pub fn row_position(d: f32, root: f32, side: HorizonSide) -> f32 {
    match side {
        HorizonSide::Above => (d / (1.0 + root)).sqrt(),
        HorizonSide::Below => {
            let grown = (1.0 + 48.0 * root).sqrt();
            let q = (8.0 * d / ((1.0 + root) * (7.0 + grown))).sqrt();
            8.0 * root / ((1.0 + grown) * (1.0 + q))
        }
    }
}

/// dX/d position, at `position`.
pub fn row_position_slope(position: f32, root: f32, side: HorizonSide) -> f32 {
    match side {
        HorizonSide::Above => -4.0 * position * root.max(1e-9),
        HorizonSide::Below => {
            let q = 1.0 - position;
            q * root.max(1e-9) * (7.0 - 6.0 * q * q)
        }
    }
}

impl GpuRow {
    /// The value and its derivative per texel at `position` (in texels), with the row's interpolation.
    pub fn interpolate(&self, position: f32) -> [f32; 2] {
        if self.format == RowFormat::Coefficients {
            let i = (position as usize).min(self.texels.len() - 1);
            let after = coefficients(&self.texels, i, self.interpolation);
            return horner(after, position - i as f32);
        }
        let i = (position as usize).min(self.texels.len() - 2);
        let (a, b, t) = (self.texels[i], self.texels[i + 1], position - i as f32);
        match self.interpolation {
            Interpolation::Linear => chord(a, b, t),
            Interpolation::Hermite => cubic(a, b, t),
        }
    }

    /// The bending in the direction (cos θ, sin θ) = (`c`, `p`), from a row on the residual axis:
    /// Δ = R(q) − (1 + weight·d) ln d with X the row coordinate, d = 1 − X, and q the position. The slope is inaccurate straight away from
    /// the hole: use [`GpuRow::bending_for_footprint`] there. For Δ alone the vector (`c`, `p`) need not be normalised; the
    /// slope needs a unit vector.
    pub fn bending(&self, c: f32, p: f32) -> RayOutcome<Bending> {
        let x = row_coordinate(c, p, self.edge, self.side);
        if x >= 1.0 {
            return RayOutcome::Captured;
        }
        let last = (self.texels.len() - 1) as f32;
        let d = 1.0 - x;
        let root = x.sqrt();
        let q = row_position(d, root, self.side);
        let [value, slope] = self.interpolate(q * last);
        let ln = d.ln();
        let factor = 1.0 + self.edge.log_weight * d;
        let dx_dq = row_position_slope(q, root, self.side);
        let by_x = slope * last / dx_dq + self.edge.log_weight * ln + factor / d;
        RayOutcome::Escapes(Bending {
            bend: value - factor * ln,
            slope: by_view_angle(by_x, x, p, self.edge, self.side),
        })
    }

    /// [`GpuRow::bending`], replaced by its limit straight away from the hole. There the terms of the residual
    /// cancel, and the size of a footprint is a quotient of the small remainders.
    pub fn bending_for_footprint(&self, c: f32, p: f32) -> RayOutcome<Bending> {
        let x = row_coordinate(c, p, self.edge, self.side);
        if c < 0.0 && p.max(x) < STRAIGHT_AWAY {
            return RayOutcome::Escapes(Bending {
                bend: self.edge.away_slope * x,
                slope: -self.edge.away_slope * self.edge.tan_half / (1.0 - c),
            });
        }
        self.bending(c, p)
    }
}

/// (cos, sin) of an angle in rad, to 1e-7 up to 100 turns: Cody and Waite's reduction to a quarter
/// turn and the polynomials of Moshier's Cephes.
pub fn cos_sin(angle: f32) -> [f32; 2] {
    let quarter = (angle * std::f32::consts::FRAC_2_PI).round();
    let r = ((angle - quarter * 1.570_312_5) - quarter * 4.837_513e-4) - quarter * 7.549_79e-8;
    let r2 = r * r;
    let sine = r + r * r2 * (-1.666_665_4e-1 + r2 * (8.332_161e-3 + r2 * -1.951_529_6e-4));
    let cosine =
        1.0 - 0.5 * r2 + r2 * r2 * (4.166_664_6e-2 + r2 * (-1.388_731_6e-3 + r2 * 2.443_315_7e-5));
    match quarter as i32 & 3 {
        0 => [cosine, sine],
        1 => [-sine, cosine],
        2 => [-cosine, -sine],
        _ => [sine, -cosine],
    }
}

/// The angle in [0, π] whose cosine and sine have the ratio `c` : `p`, with `p` ≥ 0, to 2e-7: the reduction and
/// the polynomial of Moshier's Cephes.
pub fn angle(c: f32, p: f32) -> f32 {
    use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    let a = c.abs();
    let (base, x) = if p > 2.414_213_5 * a {
        (FRAC_PI_2, -a / p)
    } else if p > 0.414_213_57 * a {
        (FRAC_PI_4, (p - a) / (p + a))
    } else {
        (0.0, p / a.max(1e-30))
    };
    let z = x * x;
    let terms = -3.333_295e-1 + z * (1.997_771_1e-1 + z * (-1.387_768_5e-1 + z * 8.053_744_6e-2));
    let first = base + (x + x * z * terms);
    if c < 0.0 { PI - first } else { first }
}

/// (cos θ′, sin θ′) of the direction turned towards the hole by the bending Δ: θ′ = θ − Δ. It has the length of (`c`, `p`).
pub fn turned(c: f32, p: f32, bend: f32) -> [f32; 2] {
    let [cos, sin] = cos_sin(bend);
    [c * cos + p * sin, p * cos - c * sin]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cos_sin_is_good_to_a_few_ulp() {
        for i in -20_000..20_000 {
            let angle = i as f32 * 1e-3;
            let [cos, sin] = cos_sin(angle);
            let (exact_sin, exact_cos) = f64::from(angle).sin_cos();
            assert!((f64::from(cos) - exact_cos).abs() < 1.5e-7, "cos {angle}");
            assert!((f64::from(sin) - exact_sin).abs() < 1.5e-7, "sin {angle}");
        }
    }

    #[test]
    fn angle_is_good_to_a_few_ulp() {
        for i in 0..=40_000 {
            let theta = std::f64::consts::PI * f64::from(i) / 40_000.0;
            let (c, p) = (theta.cos() as f32, theta.sin().max(0.0) as f32);
            let exact = f64::from(p).atan2(c.into());
            let off = (f64::from(angle(c, p)) - exact).abs();
            assert!(off < 3e-7, "{theta}: {off:e}");
        }
    }

    #[test]
    fn turning_by_nothing_changes_nothing() {
        assert_eq!(turned(0.6, 0.8, 0.0), [0.6, 0.8]);
    }
}
