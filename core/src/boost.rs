//! Boosts: the aberration of view directions.
//!
//! A boost maps the sphere of view directions conformally: with k = √((1+β)/(1−β)), it scales the stereographic
//! coordinate tan(α/2) by k, α being the angle from the direction of motion. In components, with c = cos α and n⊥ the part
//! of the unit view direction perpendicular to the motion,
//!
//! ```text
//! g = 2 / ((1+c)/k + k(1−c)),     n⊥ → g n⊥,     c → g ((1+c)/k − k(1−c)) / 2
//! ```
//!
//! maps the moving observer's direction to the other's; g is the ratio of the frequencies (moving over other), and the
//! factor by which the map scales small angles. It contains no 1 − β², so that it stays accurate at any speed.

/// A boost: a velocity as its direction and its Doppler factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boost {
    /// Unit vector of the direction of motion, in any orthonormal basis.
    pub direction: [f64; 3],
    /// k = √((1+β)/(1−β)), the Doppler factor straight ahead.
    pub doppler: f64,
}

impl Boost {
    /// Maps the unit view direction `n` in the moving frame, in the basis of [`Boost::direction`], to that of the same
    /// light in the frame relative to which it moves. Returns it with the ratio g of the frequencies, moving over
    /// other: the map scales small angles by g.
    pub fn unboosted(&self, n: [f64; 3]) -> ([f64; 3], f64) {
        let m = self.direction;
        let c: f64 = (0..3).map(|i| n[i] * m[i]).sum();
        let across: [f64; 3] = std::array::from_fn(|i| n[i] - c * m[i]);
        let sin_sq: f64 = across.iter().map(|x| x * x).sum();
        // The smaller of 1 ± c is computed from sin² α, so that it does not cancel.
        let larger = 1.0 + c.abs();
        let smaller = sin_sq / larger;
        let (plus, minus) = if c >= 0.0 {
            (larger, smaller)
        } else {
            (smaller, larger)
        };
        let (ahead, behind) = (plus / self.doppler, self.doppler * minus);
        let g = 2.0 / (ahead + behind);
        let along = 0.5 * g * (ahead - behind);
        (std::array::from_fn(|i| g * across[i] + along * m[i]), g)
    }

    /// The derivative of [`Boost::unboosted`] at the unit direction `n` along `step`, which must be perpendicular to `n`.
    pub fn unboosted_step(&self, n: [f64; 3], step: [f64; 3]) -> [f64; 3] {
        let (m, k) = (self.direction, self.doppler);
        let along = |v: [f64; 3]| -> f64 { (0..3).map(|i| v[i] * m[i]).sum() };
        let (c, dc) = (along(n), along(step));
        let (_, g) = self.unboosted(n);
        let dg = 0.5 * g * g * (k - 1.0 / k) * dc;
        // g ((1+c)/k − k(1−c)) / 2, whose derivative simplifies to g² dc, since the map is conformal.
        let d_along = g * g * dc;
        std::array::from_fn(|i| {
            let (across, d_across) = (n[i] - c * m[i], step[i] - dc * m[i]);
            dg * across + g * d_across + d_along * m[i]
        })
    }

    /// The opposite boost: maps directions in the other frame to the moving one.
    pub fn inverse(&self) -> Self {
        Boost {
            direction: self.direction,
            doppler: 1.0 / self.doppler,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn unit(theta: f64, azimuth: f64) -> [f64; 3] {
        [
            theta.cos(),
            theta.sin() * azimuth.cos(),
            theta.sin() * azimuth.sin(),
        ]
    }

    proptest! {
        #[test]
        fn the_derivative_of_a_boost_is_its_difference(
            theta in 0.01..3.13, azimuth in -PI..PI, towards in 0.0..PI, log_k in -5.3..5.3f64,
        ) {
            let boost = Boost { direction: unit(towards, 0.0), doppler: log_k.exp() };
            let h = 1e-6;
            let step = |theta: f64| unit(theta + FRAC_PI_2, azimuth);
            let found = boost.unboosted_step(unit(theta, azimuth), step(theta));
            let (ahead, _) = boost.unboosted(unit(theta + h, azimuth));
            let (behind, _) = boost.unboosted(unit(theta - h, azimuth));
            let (_, g) = boost.unboosted(unit(theta, azimuth));
            for i in 0..3 {
                let numeric = (ahead[i] - behind[i]) / (2.0 * h);
                prop_assert!((found[i] - numeric).abs() < 1e-6 * g + 1e-8, "{found:?} {numeric} {g}");
            }
            let length = found.iter().map(|x| x * x).sum::<f64>().sqrt();
            prop_assert!((length / g - 1.0).abs() < 1e-9);
        }

        #[test]
        fn a_boost_and_its_inverse_cancel(
            theta in 0.0..PI, azimuth in -PI..PI, towards in 0.0..PI, log_k in -5.3..5.3f64,
        ) {
            let boost = Boost { direction: unit(towards, 0.0), doppler: log_k.exp() };
            let n = unit(theta, azimuth);
            let (there, g) = boost.unboosted(n);
            let (back, inverse_g) = boost.inverse().unboosted(there);
            prop_assert!((there.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
            prop_assert!((g * inverse_g - 1.0).abs() < 1e-9);
            for i in 0..3 {
                prop_assert!((back[i] - n[i]).abs() < 1e-11);
            }
        }
    }
}
