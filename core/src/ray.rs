//! A light ray at its launch, and the way it takes.
//!
//! Near the photon sphere everything depends on small differences, so a ray carries them instead of
//! leaving them to be subtracted: w = 2/3 − u, and κ = 4/27 − 1/b², for which the first integral reads
//!
//! ```text
//! (dw/dφ)² = w² (1 − w) − κ.
//! ```
//!
//! κ > 0 turns round at a periapsis, κ < 0 passes over the photon sphere, κ = 0 is critical.

use crate::{CoreError, EdgeCoordinate, MAX_DISTANCE, Observer};

/// A light ray followed backwards from its observer, given at its launch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// u = 1/r at the observer.
    pub(crate) u: f64,
    /// w = 2/3 − u at the observer.
    pub(crate) w: f64,
    /// View angle from the hole, rad; 0 for an observer at infinity.
    pub(crate) theta: f64,
    /// Edge coordinate.
    pub(crate) x: f64,
    /// Whether the view direction lies within the shadow, its edge included.
    pub(crate) captured: bool,
    /// 1/b.
    pub(crate) inv_b: f64,
    /// du/dφ = cos θ / b at the launch: positive towards the hole.
    pub(crate) du_dphi: f64,
    /// κ = 4/27 − 1/b².
    pub(crate) kappa: f64,
}

/// The way of a ray.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Path {
    /// Into the horizon.
    Captured,
    /// Straight along the axis away from the hole: b = 0, no bending.
    Radial,
    /// Inwards to a periapsis and out again.
    ViaPeriapsis,
    /// Outwards from below the photon sphere, over it.
    OverPhotonSphere,
    /// Outwards from the photon sphere or above.
    Outward,
}

impl Ray {
    /// The ray that comes from infinity with impact parameter `b` (units of r_s).
    ///
    /// # Errors
    /// [`CoreError::ImpactParameter`] unless b is positive and finite, [`CoreError::TooFar`] above
    /// [`MAX_DISTANCE`].
    pub fn from_infinity(b: f64) -> Result<Self, CoreError> {
        if !(b > 0.0 && b.is_finite()) {
            return Err(CoreError::ImpactParameter(b));
        }
        if b > MAX_DISTANCE {
            return Err(CoreError::TooFar {
                what: "impact parameter",
                found: b,
            });
        }
        Ok(Observer::far().ray_at(EdgeCoordinate::from_b(b)))
    }

    /// Impact parameter b in units of r_s.
    pub fn impact_parameter(&self) -> f64 {
        1.0 / self.inv_b
    }

    /// The way this ray takes.
    pub fn path(&self) -> Path {
        if self.captured {
            Path::Captured
        } else if self.inv_b.is_infinite() || self.x <= 0.0 {
            Path::Radial
        } else if self.du_dphi > 0.0 || self.u == 0.0 {
            Path::ViaPeriapsis
        } else if self.w < 0.0 {
            Path::OverPhotonSphere
        } else {
            Path::Outward
        }
    }

    /// Δ = φ_∞ − π + θ, from the orbital angle between the observer and infinity.
    pub(crate) fn bend_from_phi(&self, phi_infinity: f64) -> f64 {
        phi_infinity - std::f64::consts::PI + self.theta
    }

    /// η = (2/3) asin(b_c/b), of which the roots of the cubic are trigonometric functions.
    fn eta(&self) -> f64 {
        2.0 / 3.0 * self.inv_b.atan2(self.kappa.sqrt())
    }

    /// π/3 − η, to full relative accuracy.
    fn eta_complement(&self) -> f64 {
        2.0 / 3.0 * self.kappa.sqrt().atan2(self.inv_b)
    }

    /// u at the periapsis: u_a = 1/3 + (2/3) sin(⅓ asin(27/(2b²) − 1)), written without
    /// cancellation. Needs κ ≥ 0.
    pub(crate) fn u_apsis(&self) -> f64 {
        let half = 0.5 * self.eta();
        4.0 / 3.0 * half.sin() * (std::f64::consts::FRAC_PI_6 - half).cos()
    }

    /// 2/3 − u_a, to full relative accuracy. Needs κ ≥ 0.
    pub(crate) fn w_apsis(&self) -> f64 {
        4.0 / 3.0 * (0.5 * self.eta()).cos() * (0.5 * self.eta_complement()).sin()
    }

    /// u₂ − u₁ between the periapsis and the negative root of the cubic. Needs κ ≥ 0.
    pub(crate) fn apsis_above_negative_root(&self) -> f64 {
        2.0 / 3.0_f64.sqrt() * self.eta().sin()
    }

    /// u₃ − u₂ between the two positive roots of the cubic. Needs κ ≥ 0.
    pub(crate) fn positive_root_gap(&self) -> f64 {
        2.0 / 3.0_f64.sqrt() * self.eta_complement().sin()
    }

    /// The negative root u₁ of u³ − u² + 1/b², and v = −1/3 − u₁, each to full relative accuracy.
    pub(crate) fn negative_root(&self) -> (f64, f64) {
        if self.kappa > 0.0 {
            let v = -4.0 / 3.0 * (0.5 * self.eta_complement()).sin().powi(2);
            let half = 0.5 * self.eta();
            let u1 = -4.0 / 3.0 * half.sin() * (std::f64::consts::FRAC_PI_6 + half).cos();
            (u1, v)
        } else {
            let q = 0.5 * (-27.0 * self.kappa).sqrt();
            let v = 4.0 / 3.0 * (q.asinh() / 3.0).sinh().powi(2);
            (-1.0 / 3.0 - v, v)
        }
    }
}
