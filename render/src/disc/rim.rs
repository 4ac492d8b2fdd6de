//! The phase at which rays reach the radius of a rim, as a polynomial.
//!
//! A ray from infinity with 1/b = s reaches the inverse radius u with |du/dψ| = m, m² = s² − u² + u³, at the phase ψ
//! ([`lensbake_core::orbit::phase`]). In flat space that phase is α = atan2(u, m), and with bending it is a smooth
//! function of α from 0 (radial rays) to π/2 (rays with their periapsis at u). So a polynomial in α serves all rays, and
//! it is all that a shader needs to know of a rim.

use lensbake_core::orbit;
use std::f64::consts::{FRAC_PI_4, PI};

/// Number of coefficients: with them the error of the phase is below 1.1e-7 rad for r ≥ 3.
pub(crate) const COEFFICIENTS: usize = 12;

/// The phases at which rays reach one radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rim {
    /// u = 1/r.
    pub(crate) u: f64,
    /// The least s² of a ray that reaches the radius.
    pub(crate) least_sq: f64,
    /// Coefficients of the phase in powers of t = 4α/π − 1, rad.
    pub(crate) coefficients: [f64; COEFFICIENTS],
}

/// Where a ray reaches a rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reached {
    /// Its phase ψ, rad.
    pub phase: f64,
    /// dψ/d(s²), with m replaced by the given least value where it is smaller.
    pub slope: f64,
}

impl Rim {
    /// The rim of radius `r` ≥ 3, with bending.
    pub fn bent(r: f64) -> Self {
        let u = 1.0 / r;
        let least_sq = u * u * (1.0 - u);
        let phase = |alpha: f64| {
            let speed = u / alpha.tan();
            // The largest angle is that of the last Chebyshev node, which is below π/2.
            orbit::phase((speed * speed + least_sq).sqrt(), u).unwrap_or(f64::NAN)
        };
        Rim {
            u,
            least_sq,
            coefficients: interpolated(|t| phase(FRAC_PI_4 * (1.0 + t))),
        }
    }

    /// The rim of radius `r` without bending, where the phase is α.
    pub fn straight(r: f64) -> Self {
        let u = 1.0 / r;
        let mut coefficients = [0.0; COEFFICIENTS];
        coefficients[..2].fill(FRAC_PI_4);
        Rim {
            u,
            least_sq: u * u,
            coefficients,
        }
    }

    /// Where the ray with s² = 1/b² = `inv_b_sq` reaches the rim; `None` if it does not. `least_speed_sq` bounds m² in
    /// the slope from below.
    pub(crate) fn reached(&self, inv_b_sq: f64, least_speed_sq: f64) -> Option<Reached> {
        let speed_sq = inv_b_sq - self.least_sq;
        if speed_sq < 0.0 {
            return None;
        }
        let t = self.u.atan2(speed_sq.sqrt()) / FRAC_PI_4 - 1.0;
        let (mut phase, mut slope) = (0.0, 0.0);
        for coefficient in self.coefficients.iter().rev() {
            slope = slope * t + phase;
            phase = phase * t + coefficient;
        }
        let speed = speed_sq.max(least_speed_sq).max(f64::MIN_POSITIVE).sqrt();
        // dα/d(m²) = −u / (2m (u² + m²)).
        let by_square = -self.u / (2.0 * speed * (self.u * self.u + speed * speed));
        Some(Reached {
            phase,
            slope: slope / FRAC_PI_4 * by_square,
        })
    }
}

/// The polynomial through the values of `f` at the Chebyshev nodes of [−1, 1], as coefficients of powers.
fn interpolated(f: impl Fn(f64) -> f64) -> [f64; COEFFICIENTS] {
    let n = COEFFICIENTS;
    let angle = |j: usize| PI * (j as f64 + 0.5) / n as f64;
    let values: [f64; COEFFICIENTS] = std::array::from_fn(|j| f(angle(j).cos()));
    let of_chebyshev = |k: usize| {
        let sum: f64 = (0..n)
            .map(|j| values[j] * (k as f64 * angle(j)).cos())
            .sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / n as f64
    };
    // Powers of t in T₀, T₁, …: T_{k+1} = 2t T_k − T_{k−1}.
    let (mut before, mut now) = ([0.0; COEFFICIENTS], [0.0; COEFFICIENTS]);
    now[0] = 1.0;
    let mut coefficients = [0.0; COEFFICIENTS];
    for k in 0..n {
        let weight = of_chebyshev(k);
        for (sum, power) in coefficients.iter_mut().zip(now) {
            *sum += weight * power;
        }
        let factor = if k == 0 { 1.0 } else { 2.0 };
        let next = std::array::from_fn(|i| {
            let raised = if i == 0 { 0.0 } else { factor * now[i - 1] };
            raised - before[i]
        });
        (before, now) = (now, next);
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_polynomial_is_the_closed_form() {
        let mut worst = 0.0_f64;
        for r in [3.0, 3.1, 4.0, 6.0, 12.0, 100.0, 1e6] {
            let rim = Rim::bent(r);
            for i in 0..1000 {
                let alpha = 0.5 * PI * f64::from(i) / 1000.0;
                let speed = if i == 0 { 1e6 } else { rim.u / alpha.tan() };
                let inv_b_sq = speed * speed + rim.least_sq;
                let found = rim.reached(inv_b_sq, 0.0).unwrap();
                let known = orbit::phase(inv_b_sq.sqrt(), rim.u).unwrap();
                worst = worst.max((found.phase - known).abs());
            }
            assert_eq!(rim.reached(0.999 * rim.least_sq, 0.0), None);
        }
        assert!(worst < 1.1e-7, "{worst:e}");
    }

    #[test]
    fn the_slope_is_the_derivative() {
        for rim in [Rim::bent(3.0), Rim::bent(12.0), Rim::straight(5.0)] {
            for part in [1.01, 1.5, 4.0, 100.0] {
                let at = rim.least_sq * part;
                let h = 1e-5 * (at - rim.least_sq);
                let phase = |at: f64| rim.reached(at, 0.0).unwrap().phase;
                let numeric = (phase(at + h) - phase(at - h)) / (2.0 * h);
                let slope = rim.reached(at, 0.0).unwrap().slope;
                assert!((slope / numeric - 1.0).abs() < 1e-5, "{slope} {numeric}");
            }
        }
    }
}
