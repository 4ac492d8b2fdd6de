//! A static observer, the edge of the shadow he sees, and the coordinate x measured from it.
//!
//! The edge lies at θ_c from the direction of the hole, sin θ_c = b_c √(1−u) u with u = 1/r, and
//! cos θ_c = b_c w √(1−w) with w = 2/3 − u, which keeps its relative accuracy at the photon sphere.
//!
//! The edge coordinate of a view angle is x = tan(θ_c/2) / tan(θ/2): 1 at the edge, 0 straight away
//! from the hole, and b_c/b for an observer at infinity. Since tan(θ/2) is the stereographic
//! coordinate of the view direction, an observer moving radially sees the same x.
//! In it the impact parameter is, with C = cos θ_c,
//!
//! ```text
//! b_c/b = ((1+C) x + (1−C)/x) / 2
//! ```
//!
//! which holds from r = ∞ (C = 1) to the horizon (C = −1) without a singular term.

use crate::{B_CRIT, BendAndSlope, CoreError, MAX_DISTANCE, Ray, U_PHOTON};

/// b_c less [`B_CRIT`], the nearest f64: what the last b beside the edge are told apart by.
const B_CRIT_REST: f64 = -7.151_834_159_792_777e-17;

/// A point of the edge coordinate: x together with 1 − x, each to full relative accuracy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeCoordinate {
    /// x = tan(θ_c/2) / tan(θ/2).
    pub x: f64,
    /// 1 − x: positive outside the shadow, zero or negative inside.
    pub one_minus_x: f64,
}

impl EdgeCoordinate {
    /// The point with x = 1 − s².
    pub fn from_s(s: f64) -> Self {
        EdgeCoordinate {
            x: (1.0 - s) * (1.0 + s),
            one_minus_x: s * s,
        }
    }

    /// The point of impact parameter `b` for an observer at infinity, x = b_c/b: right to the last b on
    /// either side of b_c.
    pub fn from_b(b: f64) -> Self {
        EdgeCoordinate {
            x: B_CRIT / b,
            one_minus_x: ((b - B_CRIT) - B_CRIT_REST) / b,
        }
    }
}

/// A static observer at area radius r ≥ 1, infinity and (as a limit) the horizon included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observer {
    /// u = 1/r.
    pub(crate) u: f64,
    /// w = 2/3 − u, the distance from the photon sphere.
    pub(crate) w: f64,
    /// √(1−u), the rate of the observer's clock.
    pub(crate) lapse: f64,
    cos_edge: f64,
    one_plus_cos_edge: f64,
    one_minus_cos_edge: f64,
    tan_half_edge: f64,
}

impl Observer {
    /// The observer at radius `r`; `r = ∞` is the observer at infinity.
    ///
    /// # Errors
    /// [`CoreError::Radius`] unless r > 1, [`CoreError::TooFar`] for a finite r above [`MAX_DISTANCE`].
    pub fn at(r: f64) -> Result<Self, CoreError> {
        if r.is_nan() || r <= 1.0 {
            return Err(CoreError::Radius(r));
        }
        if r.is_infinite() {
            return Ok(Self::far());
        }
        if r > MAX_DISTANCE {
            return Err(CoreError::TooFar {
                what: "radius",
                found: r,
            });
        }
        Ok(Self::build(
            1.0 / r,
            (2.0 * r - 3.0) / (3.0 * r),
            ((r - 1.0) / r).sqrt(),
        ))
    }

    /// The observer at infinity.
    pub fn far() -> Self {
        Self::build(0.0, U_PHOTON, 1.0)
    }

    /// The observer at 1/r = sin²χ, χ from 0 (infinity) to π/2 (the limit at the horizon).
    pub fn at_chi(chi: f64) -> Self {
        let (sin, cos) = chi.sin_cos();
        let u = sin * sin;
        // cos(π/2) is not 0 in floating point; there the limit itself is meant.
        let lapse = if chi >= std::f64::consts::FRAC_PI_2 {
            0.0
        } else {
            cos
        };
        Self::build(u, U_PHOTON - u, lapse)
    }

    fn build(u: f64, w: f64, lapse: f64) -> Self {
        let cos_edge = (B_CRIT * w * (1.0 - w).sqrt()).clamp(-1.0, 1.0);
        let sin_edge = B_CRIT * u * lapse;
        // The smaller of 1 ± C from sin²θ_c = (1+C)(1−C), so that neither cancels.
        let (one_plus_cos_edge, one_minus_cos_edge) = if cos_edge >= 0.0 {
            let plus = 1.0 + cos_edge;
            (plus, sin_edge * sin_edge / plus)
        } else {
            let minus = 1.0 - cos_edge;
            (sin_edge * sin_edge / minus, minus)
        };
        let tan_half_edge = if cos_edge >= 0.0 {
            sin_edge / one_plus_cos_edge
        } else {
            one_minus_cos_edge / sin_edge
        };
        Observer {
            u,
            w,
            lapse,
            cos_edge,
            one_plus_cos_edge,
            one_minus_cos_edge,
            tan_half_edge,
        }
    }

    /// r in units of r_s; ∞ for the observer at infinity.
    pub fn radius(&self) -> f64 {
        1.0 / self.u
    }

    /// 1/r, 0 at infinity.
    pub fn inverse_radius(&self) -> f64 {
        self.u
    }

    /// √(1 − 1/r), the rate of the observer's clock against one at infinity.
    pub fn lapse(&self) -> f64 {
        self.lapse
    }

    /// χ with 1/r = sin²χ, in [0, π/2]: the coordinate along which the atlas has its rows.
    pub fn chi(&self) -> f64 {
        self.u.sqrt().atan2(self.lapse)
    }

    /// True for the observer at infinity, whose rays have an impact parameter but no view angle.
    pub fn is_far(&self) -> bool {
        self.u == 0.0
    }

    /// θ_c, the angle from the direction of the hole to the shadow's edge, in rad.
    pub fn edge_angle(&self) -> f64 {
        2.0 * self.tan_half_edge.atan()
    }

    /// cos θ_c: 1 at infinity, 0 at the photon sphere, −1 at the horizon.
    pub fn cos_edge(&self) -> f64 {
        self.cos_edge
    }

    /// tan(θ_c/2), the factor of the axis map; 0 at infinity.
    pub fn tan_half_edge(&self) -> f64 {
        self.tan_half_edge
    }

    /// The edge coordinate of the view angle `theta` in [0, π] (rad); x = ∞ at θ = 0.
    pub fn edge_coordinate(&self, theta: f64) -> EdgeCoordinate {
        // −0, which is in [0, π], would change the sign of x.
        let theta = theta + 0.0;
        let (half_sin, half_cos) = (0.5 * theta).sin_cos();
        let offset = (0.5 * (theta - self.edge_angle())).sin();
        let half_cos_edge = 1.0 / self.tan_half_edge.hypot(1.0);
        EdgeCoordinate {
            x: self.tan_half_edge * half_cos / half_sin,
            one_minus_x: offset / (half_sin * half_cos_edge),
        }
    }

    /// The inverse of [`Observer::edge_coordinate`]: θ = 2 atan(tan(θ_c/2)/x), rad; 0 at infinity.
    pub fn view_angle(&self, x: f64) -> f64 {
        2.0 * self.tan_half_edge.atan2(x)
    }

    /// dθ/dx = −sin θ / x at the edge coordinate `x`, finite on [0, 1].
    pub fn view_angle_slope(&self, x: f64) -> f64 {
        -2.0 / (x * x / self.tan_half_edge + self.tan_half_edge)
    }

    /// dΔ/dx at x = 0, where b → 0 outwards and Δ → (π − θ) (1/√(1−u) − 1).
    pub fn bend_slope_away(&self) -> f64 {
        if self.cos_edge >= 0.0 {
            2.0 * self.one_plus_cos_edge / (B_CRIT * self.lapse.powi(2) * (1.0 + self.lapse))
        } else {
            2.0 * B_CRIT * self.u.powi(2) / (self.one_minus_cos_edge * (1.0 + self.lapse))
        }
    }

    /// The bending and dΔ/dx where `at` is straight away from the hole, to 1e-13 of themselves: Δ is there
    /// proportional to x, where integrals and tables are differences of larger numbers. `None` elsewhere,
    /// and at infinity, whose observer has no such direction.
    pub fn bend_straight_away(&self, at: EdgeCoordinate) -> Option<BendAndSlope> {
        // A small part of the window to the sky, and a small angle: tan((π − θ)/2) = x / tan(θ_c/2).
        const NEAR: f64 = 1e-7;
        let slope = self.bend_slope_away();
        (at.x <= NEAR * self.tan_half_edge.min(1.0) && !self.is_far()).then_some(BendAndSlope {
            bend: slope * at.x,
            slope,
        })
    }

    /// The ray in the direction `theta` from the hole, in [0, π] (rad).
    ///
    /// # Errors
    /// [`CoreError::ViewAngle`] outside that range, [`CoreError::FarHasNoAngle`] at infinity.
    pub fn ray(&self, theta: f64) -> Result<Ray, CoreError> {
        if !(0.0..=std::f64::consts::PI).contains(&theta) {
            return Err(CoreError::ViewAngle(theta));
        }
        if self.is_far() {
            return Err(CoreError::FarHasNoAngle);
        }
        Ok(self.launch(self.edge_coordinate(theta), theta))
    }

    /// The ray at the edge coordinate `at`: exact however close to the shadow's edge it is.
    pub fn ray_at(&self, at: EdgeCoordinate) -> Ray {
        self.launch(at, self.view_angle(at.x))
    }

    fn launch(&self, at: EdgeCoordinate, theta: f64) -> Ray {
        let EdgeCoordinate { x, one_minus_x } = at;
        let (plus, minus) = (self.one_plus_cos_edge, self.one_minus_cos_edge);
        let b_crit_over_b = 0.5 * (plus * x + minus / x);
        // 1 − b_c/b, rewritten in 1 − x so that it keeps its accuracy at the edge.
        let below_critical = one_minus_x * (self.cos_edge - 0.5 * minus * one_minus_x / x);
        let cos_theta = {
            let numerator = if one_minus_x < 0.5 {
                2.0 * self.cos_edge - plus * one_minus_x * (1.0 + x)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shadow_has_its_known_radius() {
        for (r, degrees) in [
            (2.0, 66.716_268_28),
            (3.0, 45.0),
            (10.0, 14.269_027_33),
            (50.0, 2.948_555_198),
        ] {
            let edge = Observer::at(r).unwrap().edge_angle().to_degrees();
            assert!((edge - degrees).abs() < 1e-8, "r {r}: {edge}");
        }
        let at_photon_sphere = Observer::at(1.5).unwrap().edge_angle();
        assert!((at_photon_sphere - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    }

    /// b_c = 2.598 076 211 353 315 94… lies between two f64.
    #[test]
    fn the_edge_lies_between_two_impact_parameters() {
        assert!(EdgeCoordinate::from_b(B_CRIT).one_minus_x > 0.0);
        assert!(EdgeCoordinate::from_b(B_CRIT.next_down()).one_minus_x < 0.0);
    }

    #[test]
    fn radii_at_or_below_the_horizon_are_refused() {
        for r in [1.0, 0.5, 0.0, -3.0, f64::NAN, f64::NEG_INFINITY] {
            assert!(matches!(Observer::at(r), Err(CoreError::Radius(_))), "{r}");
        }
        assert!(Observer::at(f64::INFINITY).unwrap().is_far());
    }

    #[test]
    fn distances_too_large_to_compute_with_are_refused() {
        assert!(Observer::at(MAX_DISTANCE).is_ok());
        for r in [MAX_DISTANCE.next_up(), 1e162, f64::MAX] {
            assert!(matches!(Observer::at(r), Err(CoreError::TooFar { .. })));
            assert!(matches!(
                Ray::from_infinity(r),
                Err(CoreError::TooFar { .. })
            ));
        }
    }

    #[test]
    fn angles_that_are_none_are_refused() {
        let observer = Observer::at(4.0).unwrap();
        for theta in [-1e-9, 3.2, f64::NAN, f64::INFINITY] {
            assert!(matches!(observer.ray(theta), Err(CoreError::ViewAngle(_))));
        }
        assert_eq!(Observer::far().ray(0.1), Err(CoreError::FarHasNoAngle));
    }

    #[test]
    fn chi_runs_from_infinity_to_the_horizon() {
        for r in [1.0001, 1.5, 7.0, 1e5] {
            let observer = Observer::at(r).unwrap();
            let again = Observer::at_chi(observer.chi());
            assert!((again.radius() / r - 1.0).abs() < 1e-12);
            assert!((again.edge_angle() - observer.edge_angle()).abs() < 1e-12);
        }
    }
}
