//! An observer on a radial path, the shadow boundary as this observer sees it, and the normalised shadow coordinate x.
//!
//! **At rest.** The shadow boundary (critical curve) is the circle at the angle θ_c from the direction of the hole.
//! With u = 1/r and w = 2/3 − u, sin θ_c = b_c √(1−u) u and cos θ_c = b_c w √(1−w); the latter keeps its relative
//! accuracy at the photon sphere.
//!
//! **The normalised shadow coordinate** of a view angle θ is x = tan(θ_c/2) / tan(θ/2): 1 at the shadow boundary, 0
//! straight away from the hole, and b_c/b for an observer at infinity. Since tan(θ/2) is the stereographic
//! coordinate of the view direction, which a radial boost only scales, all observers in radial motion at r see the
//! same ray at the same x. With C = b_c w √(1−w), the impact parameter b is given by
//!
//! ```text
//! b_c/b = ((1+C) x + (1−C)/x) / 2,      du/dφ = ((1+C) x − (1−C)/x) / (2 b_c)
//! ```
//!
//! for all r > 0: C is 1 at infinity, −1 at the horizon, and below −1 inside, where nobody is at rest. Rays with x < 1
//! come from the sky.
//!
//! **In radial motion.** With z_in and z_out the redshift factors 1 + z = ν_∞/ν_obs of light that is seen in the
//! direction of the hole and straight away from it,
//!
//! ```text
//! z_in z_out = 1 − u,     tan(θ_c/2) = (1−C) / (b_c u z_out),     ν_∞/ν_obs = z_in cos²(θ/2) + z_out sin²(θ/2).
//! ```
//!
//! z_out = √(1−u) at rest, and 1 + √u for an observer who has fallen from rest at infinity (Painlevé–Gullstrand
//! frame). z_out > 0 is the only parameter of the motion, so one set of formulae serves every radial motion from
//! infinity to the singularity.

mod place;
mod rays;
mod shadow_coordinate;

pub use shadow_coordinate::ShadowCoordinate;

use crate::{B_CRIT, CoreError, MAX_DISTANCE, MIN_RADIUS, U_PHOTON};
use place::{Place, Redshift};

/// An observer at areal radius r who is at rest or moves radially.
///
/// ```
/// use lensbake_core::Observer;
///
/// // At rest on the photon sphere the shadow fills half of the sky; in free fall, less.
/// let observer = Observer::at(1.5).unwrap();
/// assert!((observer.shadow_angle().to_degrees() - 90.0).abs() < 1e-12);
/// let falling = Observer::falling(1.5).unwrap();
/// assert!((falling.shadow_angle().to_degrees() - 35.264_390).abs() < 1e-6);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observer {
    /// u = 1/r.
    pub(crate) u: f64,
    /// w = 2/3 − u, the distance from the photon sphere.
    pub(crate) w: f64,
    /// 1 − u, to full relative accuracy.
    one_minus_u: f64,
    /// z_out, the redshift factor of light from straight away.
    z_out: f64,
    /// (1 − z_out)/u.
    gain_out: f64,
    cos_shadow: f64,
    one_plus_cos_shadow: f64,
    one_minus_cos_shadow: f64,
    tan_half_shadow: f64,
}

fn check_distance(r: f64) -> Result<(), CoreError> {
    if r > MAX_DISTANCE && r.is_finite() {
        return Err(CoreError::TooFar {
            what: "radius",
            found: r,
        });
    }
    Ok(())
}

impl Observer {
    /// The observer at rest at radius `r`; `r = ∞` is the observer at infinity.
    ///
    /// # Errors
    /// [`CoreError::Radius`] unless r > 1, [`CoreError::TooFar`] for a finite r above [`MAX_DISTANCE`].
    pub fn at(r: f64) -> Result<Self, CoreError> {
        if r.is_nan() || r <= 1.0 {
            return Err(CoreError::Radius(r));
        }
        if r.is_infinite() {
            return Ok(Self::at_infinity());
        }
        check_distance(r)?;
        let place = Place::at(r);
        Ok(Self::build(place, Redshift::at_rest(place)))
    }

    /// The observer at radius `r` who has fallen freely from rest at infinity, at the speed √(1/r) relative to an
    /// observer at rest there. Far away this is the observer at rest at infinity.
    ///
    /// # Errors
    /// [`CoreError::Singularity`] unless r ≥ [`MIN_RADIUS`], [`CoreError::TooFar`] for a finite r above
    /// [`MAX_DISTANCE`].
    pub fn falling(r: f64) -> Result<Self, CoreError> {
        if r.is_nan() || r < MIN_RADIUS {
            return Err(CoreError::Singularity(r));
        }
        if r.is_infinite() {
            return Ok(Self::at_infinity());
        }
        check_distance(r)?;
        let place = Place::at(r);
        Ok(Self::build(place, Redshift::in_fall(place)))
    }

    /// The observer at infinity.
    pub fn at_infinity() -> Self {
        let place = Place::INFINITY;
        Self::build(place, Redshift::at_rest(place))
    }

    /// The observer at rest at 1/r = sin²χ, for χ from 0 (infinity) to π/2 (the limit at the horizon).
    pub fn at_chi(chi: f64) -> Self {
        let (sin, cos) = chi.sin_cos();
        let u = sin * sin;
        // cos(π/2) is not 0 in floating point, but χ = π/2 is the horizon, where the lapse is 0.
        let lapse = if chi >= std::f64::consts::FRAC_PI_2 {
            0.0
        } else {
            cos
        };
        let place = Place {
            u,
            w: U_PHOTON - u,
            one_minus_u: lapse * lapse,
            lapse,
        };
        Self::build(place, Redshift::at_rest(place))
    }

    /// The same place in the frame that the rows of a table refer to. Above the horizon that is the observer at
    /// rest. At the horizon and below, nobody is at rest; there it is the limit of an infinitely fast outward motion
    /// (z_out → 0), for which every view angle is π and the bending is the orbital angle φ from the outward direction
    /// to the sky. At the horizon both are the same.
    pub fn in_row_frame(&self) -> Self {
        let place = self.place();
        Self::build(place, Redshift::at_rest(place))
    }

    /// The observer at this place relative to whom velocities are given: at rest above the horizon, in free fall at the
    /// horizon and below.
    pub fn base(&self) -> Self {
        let place = self.place();
        let redshift = match self.is_inside() {
            true => Redshift::in_fall(place),
            false => Redshift::at_rest(place),
        };
        Self::build(place, redshift)
    }

    /// The same observer after a radial boost: `doppler` is √((1+β)/(1−β)) for the speed β towards the hole
    /// relative to `self`.
    pub fn boosted(&self, doppler: f64) -> Self {
        let z_out = self.z_out * doppler;
        let redshift = Redshift {
            z_out,
            gain_out: (1.0 - z_out) / self.u,
        };
        Self::build(self.place(), redshift)
    }

    fn place(&self) -> Place {
        Place {
            u: self.u,
            w: self.w,
            one_minus_u: self.one_minus_u,
            lapse: self.lapse(),
        }
    }

    fn build(place: Place, redshift: Redshift) -> Self {
        let Place {
            u,
            w,
            one_minus_u,
            lapse,
        } = place;
        let Redshift { z_out, gain_out } = redshift;
        let cos_shadow = (B_CRIT * w * (1.0 - w).sqrt()).min(1.0);
        let sin_shadow = B_CRIT * u * lapse;
        // The smaller of 1 ± C is computed from 1 − C² = b_c² u² (1−u), so that neither cancels.
        let (one_plus_cos_shadow, one_minus_cos_shadow) = if cos_shadow >= 0.0 {
            let plus = 1.0 + cos_shadow;
            (plus, sin_shadow * sin_shadow / plus)
        } else {
            let minus = 1.0 - cos_shadow;
            let product = (B_CRIT * u) * (B_CRIT * u) * one_minus_u;
            (product / minus, minus)
        };
        let tan_half_shadow = if cos_shadow >= 0.0 {
            sin_shadow / one_plus_cos_shadow * (lapse / z_out)
        } else {
            one_minus_cos_shadow / (B_CRIT * u * z_out)
        };
        Observer {
            u,
            w,
            one_minus_u,
            z_out,
            gain_out,
            cos_shadow,
            one_plus_cos_shadow,
            one_minus_cos_shadow,
            tan_half_shadow,
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

    /// The lapse √(1 − 1/r): the rate of a clock at rest at this radius relative to one at infinity. 0 at and below the
    /// horizon.
    pub fn lapse(&self) -> f64 {
        self.one_minus_u.max(0.0).sqrt()
    }

    /// True at the horizon and below, where no observer can be at rest.
    pub fn is_inside(&self) -> bool {
        self.one_minus_u <= 0.0
    }

    /// True for the observer at rest.
    pub fn is_at_rest(&self) -> bool {
        let excess = self.z_out * self.z_out - self.one_minus_u;
        !self.is_inside() && excess.abs() <= 4.0 * f64::EPSILON * self.one_minus_u
    }

    /// The redshift factors 1 + z = ν_∞/ν_obs of light from the direction of the hole and from straight away,
    /// [z_in, z_out]. z_in ≤ 0 at the horizon and below: no light of the sky comes from there.
    pub fn redshifts(&self) -> [f64; 2] {
        [self.one_minus_u / self.z_out, self.z_out]
    }

    /// ν_obs/ν_∞ of light of the sky that is seen at the view angle `theta` (rad): the frequency at the observer divided
    /// by that at infinity. Infinite or negative where no light of the sky can come from.
    pub fn frequency_shift(&self, theta: f64) -> f64 {
        let [z_in, z_out] = self.redshifts();
        if self.is_at_rest() {
            return 1.0 / z_out;
        }
        let (sin, cos) = (0.5 * theta).sin_cos();
        1.0 / (z_in * cos * cos + z_out * sin * sin)
    }

    /// χ with 1/r = sin²χ, in [0, π/2]: the coordinate in which the rows of the atlas are uniform above the horizon.
    pub fn chi(&self) -> f64 {
        self.u.sqrt().atan2(self.lapse())
    }

    /// True for the observer at infinity, whose rays have an impact parameter but no view angle.
    pub fn is_at_infinity(&self) -> bool {
        self.u == 0.0
    }

    /// Whether it has view angles: neither the observer at infinity nor the limit [`Observer::in_row_frame`] at the horizon
    /// and below has.
    pub fn has_view_angles(&self) -> bool {
        !self.is_at_infinity() && self.z_out > 0.0
    }

    /// θ_c, the angle from the direction of the hole to the shadow boundary, in rad.
    pub fn shadow_angle(&self) -> f64 {
        2.0 * self.tan_half_shadow.atan()
    }

    /// C = b_c w √(1−w): cos θ_c of the observer at rest. 1 at infinity, 0 at the photon sphere, −1 at the horizon, and
    /// below −1 inside.
    pub fn cos_shadow_at_rest(&self) -> f64 {
        self.cos_shadow
    }

    /// tan(θ_c/2), the factor in x = tan(θ_c/2) / tan(θ/2); 0 at infinity.
    pub fn tan_half_shadow(&self) -> f64 {
        self.tan_half_shadow
    }

    /// The normalised shadow coordinate of the view angle `theta` in [0, π] (rad); x = ∞ at θ = 0.
    pub fn shadow_coordinate(&self, theta: f64) -> ShadowCoordinate {
        // Turns −0, which is in [0, π] but would change the sign of x, into +0.
        let theta = theta + 0.0;
        let (half_sin, half_cos) = (0.5 * theta).sin_cos();
        let offset = (0.5 * (theta - self.shadow_angle())).sin();
        let half_cos_shadow = 1.0 / self.tan_half_shadow.hypot(1.0);
        ShadowCoordinate {
            x: self.tan_half_shadow * half_cos / half_sin,
            one_minus_x: offset / (half_sin * half_cos_shadow),
        }
    }

    /// The normalised shadow coordinate of the view direction with cos θ = `cos` and sin θ = `sin` ≥ 0, by two divisions and
    /// no trigonometric function. Next to the edge of the shadow 1 − x has the rounding error of x, and no more is known of
    /// it from a cosine and a sine. `sin` = 0 is straight away or, with x = ∞, the direction of the hole.
    ///
    /// ```
    /// use lensbake_core::Observer;
    ///
    /// let observer = Observer::at(10.0).unwrap();
    /// let (sin, cos) = 0.5_f64.sin_cos();
    /// let at = observer.shadow_coordinate_of(cos, sin);
    /// assert!((at.x - observer.shadow_coordinate(0.5).x).abs() < 1e-15);
    /// ```
    #[inline]
    pub fn shadow_coordinate_of(&self, cos: f64, sin: f64) -> ShadowCoordinate {
        // cot(θ/2), without the cancellation of 1 + cos θ.
        let cot_half = if cos >= 0.0 {
            (1.0 + cos) / sin
        } else {
            sin / (1.0 - cos)
        };
        let x = self.tan_half_shadow * cot_half;
        ShadowCoordinate {
            x,
            one_minus_x: 1.0 - x,
        }
    }

    /// The inverse of [`Observer::shadow_coordinate`]: θ = 2 atan(tan(θ_c/2)/x), rad; 0 at infinity.
    pub fn view_angle(&self, x: f64) -> f64 {
        2.0 * self.tan_half_shadow.atan2(x)
    }

    /// dθ/dx = −sin θ / x at the normalised shadow coordinate `x`, finite on [0, 1].
    pub fn view_angle_slope(&self, x: f64) -> f64 {
        -2.0 / (x * x / self.tan_half_shadow + self.tan_half_shadow)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ray;

    #[test]
    fn the_shadow_has_its_known_radius() {
        for (r, degrees) in [
            (2.0, 66.716_268_28),
            (3.0, 45.0),
            (10.0, 14.269_027_33),
            (50.0, 2.948_555_198),
        ] {
            let edge = Observer::at(r).unwrap().shadow_angle().to_degrees();
            assert!((edge - degrees).abs() < 1e-8, "r {r}: {edge}");
        }
        let at_photon_sphere = Observer::at(1.5).unwrap().shadow_angle();
        assert!((at_photon_sphere - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    }

    #[test]
    fn radii_at_or_below_the_horizon_are_refused() {
        for r in [1.0, 0.5, 0.0, -3.0, f64::NAN, f64::NEG_INFINITY] {
            assert!(matches!(Observer::at(r), Err(CoreError::Radius(_))), "{r}");
        }
        assert!(Observer::at(f64::INFINITY).unwrap().is_at_infinity());
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
    fn invalid_angles_are_refused() {
        let observer = Observer::at(4.0).unwrap();
        for theta in [-1e-9, 3.2, f64::NAN, f64::INFINITY] {
            assert!(matches!(observer.ray(theta), Err(CoreError::ViewAngle(_))));
        }
        assert_eq!(
            Observer::at_infinity().ray(0.1),
            Err(CoreError::NoViewAngle)
        );
    }

    #[test]
    fn chi_runs_from_infinity_to_the_horizon() {
        for r in [1.0001, 1.5, 7.0, 1e5] {
            let observer = Observer::at(r).unwrap();
            let again = Observer::at_chi(observer.chi());
            assert!((again.radius() / r - 1.0).abs() < 1e-12);
            assert!((again.shadow_angle() - observer.shadow_angle()).abs() < 1e-12);
        }
    }
}
