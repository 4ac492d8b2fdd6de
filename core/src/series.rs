//! The weak-field and the strong-deflection limit of the deflection angle, for an observer at infinity.

use crate::B_CRIT;

/// Weak-field limit: Δφ = 4x + (15π/4) x² + (128/3) x³ + (3465π/64) x⁴ + O(x⁵), x = 1/(2b), in rad (Keeton &
/// Petters 2005, Phys. Rev. D 72, 104006). The error is below 1e3 x⁵ for b > 10.
pub fn weak(b: f64) -> f64 {
    use std::f64::consts::PI;
    let x = 0.5 / b;
    let c = [4.0, 15.0 * PI / 4.0, 128.0 / 3.0, 3465.0 * PI / 64.0];
    x * (c[0] + x * (c[1] + x * (c[2] + x * c[3])))
}

/// Strong-deflection limit: Δφ = −ln(b/b_c − 1) + ln[216 (7 − 4√3)] − π, in rad (Bozza 2002, Phys. Rev. D 66,
/// 103001). The error vanishes as (b/b_c − 1) ln(b/b_c − 1).
pub fn strong(b: f64) -> f64 {
    let excess = (b - B_CRIT) / B_CRIT;
    -excess.ln() + strong_constant()
}

/// ln[216 (7 − 4√3)] − π.
fn strong_constant() -> f64 {
    (216.0 * (7.0 - 4.0 * 3.0_f64.sqrt())).ln() - std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ray, exact};

    fn closed(b: f64) -> f64 {
        exact::bend(&Ray::from_infinity(b).unwrap())
            .escaped()
            .unwrap()
    }

    #[test]
    fn the_weak_series_meets_the_closed_form() {
        for b in [20.0, 100.0, 1e3, 1e4] {
            let x: f64 = 0.5 / b;
            let error = (weak(b) - closed(b)).abs();
            assert!(error < 1e3 * x.powi(5) + 1e-12, "b {b}: {error:e}");
        }
    }

    #[test]
    fn the_strong_limit_meets_the_closed_form() {
        for excess in [1e-3, 1e-4, 1e-6, 1e-8] {
            let b = B_CRIT * (1.0 + excess);
            let error = (strong(b) - closed(b)).abs();
            let allowed = excess * -f64::ln(excess) + 1e-15 / excess;
            assert!(error < allowed, "excess {excess:e}: {error:e}");
        }
    }
}
