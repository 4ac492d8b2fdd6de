//! A light ray, given by its initial conditions at the observer, and the kind of path it follows.
//!
//! Near the photon sphere the bending depends on small differences. A ray carries these, so that they need not be
//! computed by subtraction: w = 2/3 − u, and κ = 4/27 − 1/b², for which the first integral is
//!
//! ```text
//! (dw/dφ)² = w² (1 − w) − κ.
//! ```
//!
//! κ > 0: the ray turns round at a periapsis. κ < 0: it crosses the photon sphere. κ = 0: it is critical, b = b_c.

use crate::{CoreError, MAX_DISTANCE, Observer, ShadowCoordinate, U_PHOTON};

/// A light ray traced backwards from the observer, given by its initial conditions there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// u = 1/r at the observer.
    pub(crate) u: f64,
    /// w = 2/3 − u at the observer.
    pub(crate) w: f64,
    /// View angle from the direction of the hole, rad; 0 for an observer at infinity.
    pub(crate) theta: f64,
    /// Normalised shadow coordinate x.
    pub(crate) x: f64,
    /// Whether the view direction lies inside the shadow or on its boundary.
    pub(crate) captured: bool,
    /// 1/b.
    pub(crate) inv_b: f64,
    /// du/dφ = cos θ / b at the observer: positive towards the hole.
    pub(crate) du_dphi: f64,
    /// κ = 4/27 − 1/b².
    pub(crate) kappa: f64,
}

/// The kind of path that a ray follows, traced backwards from the observer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Path {
    /// Ends at the horizon.
    Captured,
    /// Radially outwards (b = 0, no bending); also x = 0 (b = ∞) for an observer at infinity.
    Radial,
    /// Inwards to a periapsis and out again.
    ViaPeriapsis,
    /// Outwards from an observer inside the photon sphere, across it.
    OverPhotonSphere,
    /// Outwards from an observer on or outside the photon sphere.
    Outward,
}

impl Ray {
    /// The ray from infinity with impact parameter `b` (units of r_s).
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
        Ok(Observer::at_infinity().ray_at(ShadowCoordinate::from_b(b)))
    }

    /// The ray with 1/b = `inv_b` that leaves the inverse radius `u` outwards at |du/dφ| = `speed`. It has no view angle
    /// and no shadow coordinate.
    pub(crate) fn leaving(u: f64, inv_b: f64, speed: f64) -> Self {
        Ray {
            u,
            w: U_PHOTON - u,
            theta: f64::NAN,
            x: f64::NAN,
            captured: false,
            inv_b,
            du_dphi: -speed,
            kappa: 4.0 / 27.0 - inv_b * inv_b,
        }
    }

    /// Impact parameter b in units of r_s.
    pub fn impact_parameter(&self) -> f64 {
        1.0 / self.inv_b
    }

    /// The kind of path that this ray follows.
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

    /// Δ = φ_∞ − π + θ, with φ_∞ the orbital angle between the observer and infinity.
    pub(crate) fn bend_from_phi(&self, phi_infinity: f64) -> f64 {
        phi_infinity - std::f64::consts::PI + self.theta
    }

    /// η = (2/3) asin(b_c/b). The roots of the cubic u³ − u² + 1/b² are trigonometric functions of η.
    fn eta(&self) -> f64 {
        2.0 / 3.0 * self.inv_b.atan2(self.kappa.sqrt())
    }

    /// π/3 − η, to full relative accuracy.
    fn eta_complement(&self) -> f64 {
        2.0 / 3.0 * self.kappa.sqrt().atan2(self.inv_b)
    }

    /// u at the periapsis: u_a = 1/3 + (2/3) sin(⅓ asin(27/(2b²) − 1)), written without cancellation. Needs κ ≥ 0.
    pub(crate) fn u_apsis(&self) -> f64 {
        let half = 0.5 * self.eta();
        4.0 / 3.0 * half.sin() * (std::f64::consts::FRAC_PI_6 - half).cos()
    }

    /// 2/3 − u_a, to full relative accuracy. Needs κ ≥ 0.
    pub(crate) fn w_apsis(&self) -> f64 {
        4.0 / 3.0 * (0.5 * self.eta()).cos() * (0.5 * self.eta_complement()).sin()
    }

    /// u₂ − u₁: the root at the periapsis minus the negative root of the cubic. Needs κ ≥ 0.
    pub(crate) fn apsis_above_negative_root(&self) -> f64 {
        2.0 / 3.0_f64.sqrt() * self.eta().sin()
    }

    /// u₃ − u₂: the difference of the two positive roots of the cubic. Needs κ ≥ 0.
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
