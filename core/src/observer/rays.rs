//! The rays that an observer sees, and their bending straight away from the hole, where it is a limit.

use super::{Observer, ShadowCoordinate};
use crate::{B_CRIT, BendAndSlope, CoreError, Ray};

impl Observer {
    /// dΔ/dx at x = 0, straight away from the hole, where b → 0 and Δ → (π − θ) (1/z_out − 1).
    pub fn bend_slope_away(&self) -> f64 {
        if self.cos_shadow >= 0.0 {
            2.0 * self.one_plus_cos_shadow * self.gain_out / (B_CRIT * self.one_minus_u)
        } else {
            2.0 * B_CRIT * self.u.powi(2) * self.gain_out / self.one_minus_cos_shadow
        }
    }

    /// The bending and dΔ/dx near the direction straight away from the hole, with a relative error of 1e-13. There
    /// Δ is proportional to x, whereas integrals and tables compute it as a difference of larger numbers. `None`
    /// in other directions, and for the observer at infinity, who has no such direction.
    pub fn bend_straight_away(&self, at: ShadowCoordinate) -> Option<BendAndSlope> {
        // Bound on x and on tan((π − θ)/2) = x / tan(θ_c/2), the angle from the outward direction.
        const NEAR: f64 = 1e-7;
        let is_away = at.x <= NEAR * self.tan_half_shadow.min(1.0) && !self.is_at_infinity();
        is_away.then(|| {
            let slope = self.bend_slope_away();
            BendAndSlope {
                bend: slope * at.x,
                slope,
            }
        })
    }

    /// The ray at the view angle `theta` from the direction of the hole, in [0, π] (rad).
    ///
    /// # Errors
    /// [`CoreError::ViewAngle`] outside that range, [`CoreError::NoViewAngle`] unless [`Observer::has_view_angles`].
    pub fn ray(&self, theta: f64) -> Result<Ray, CoreError> {
        if !(0.0..=std::f64::consts::PI).contains(&theta) {
            return Err(CoreError::ViewAngle(theta));
        }
        if !self.has_view_angles() {
            return Err(CoreError::NoViewAngle);
        }
        Ok(self.ray_with(self.shadow_coordinate(theta), theta))
    }

    /// The normalised shadow coordinate of the ray that leaves in the opposite direction along the same path: it has the
    /// same b, and du/dφ of the other sign. As x itself it does not depend on the radial motion.
    pub fn opposite(&self, at: ShadowCoordinate) -> ShadowCoordinate {
        let x = self.one_minus_cos_shadow / (self.one_plus_cos_shadow * at.x);
        ShadowCoordinate {
            x,
            one_minus_x: 1.0 - x,
        }
    }

    /// The ray at the normalised shadow coordinate `at`. It keeps full accuracy however close it is to the shadow
    /// boundary.
    pub fn ray_at(&self, at: ShadowCoordinate) -> Ray {
        self.ray_with(at, self.view_angle(at.x))
    }

    fn ray_with(&self, at: ShadowCoordinate, theta: f64) -> Ray {
        let ShadowCoordinate { x, one_minus_x } = at;
        let (plus, minus) = (self.one_plus_cos_shadow, self.one_minus_cos_shadow);
        let b_crit_over_b = 0.5 * (plus * x + minus / x);
        // 1 − b_c/b, rewritten in 1 − x so that it keeps its accuracy at the shadow boundary.
        let below_critical = one_minus_x * (self.cos_shadow - 0.5 * minus * one_minus_x / x);
        let cos_theta = {
            let numerator = if one_minus_x < 0.5 {
                2.0 * self.cos_shadow - plus * one_minus_x * (1.0 + x)
            } else {
                plus * x * x - minus
            };
            numerator / (plus * x * x + minus)
        };
        let inv_b = b_crit_over_b / B_CRIT;
        Ray {
            u: self.u,
            w: self.w,
            theta,
            x,
            captured: one_minus_x <= 0.0,
            inv_b,
            du_dphi: inv_b * cos_theta,
            kappa: 4.0 / 27.0 * below_critical * (1.0 + b_crit_over_b),
        }
    }
}
