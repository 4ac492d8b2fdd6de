//! The rest frame of an observer in any motion: aberration and frequency shift.
//!
//! A radial motion changes only the shadow's angular radius and the view angle: it is part of the [`Observer`]. Any other
//! motion is a [`Boost`] relative to an observer at rest (at the horizon and below, to the observer in free fall).

use crate::geodesic::orbit_speed;
use crate::{Boost, CoreError, Motion, Observer};

/// The rest frame of an observer in any motion. Directions have the components (towards the hole, along the tangential
/// part of the motion, across both), in the axes of the observer at rest or in free fall, carried along by the boost
/// without rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingFrame {
    observer: Observer,
    boost: Option<Boost>,
}

/// Where the light of a view direction comes from, as the observer in radial motion sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnboostedDirection {
    /// View angle θ from the direction of the hole, rad.
    pub theta: f64,
    /// Azimuth about the direction of the hole, from the tangential part of the motion, rad.
    pub azimuth: f64,
    /// Ratio of the frequencies, observer over the observer in radial motion.
    pub doppler: f64,
}

impl MovingFrame {
    /// The frame of the observer in this motion at radius `r`; `r = ∞` is possible unless the motion is a velocity.
    ///
    /// # Errors
    /// [`CoreError`] if nobody can move so: at rest at or below the horizon, in orbit at r ≤ 3/2, at the speed of light
    /// or above; or if the radius is out of range.
    ///
    /// ```
    /// use lensbake_core::{Motion, MovingFrame};
    ///
    /// let orbit = MovingFrame::new(3.0, Motion::Orbit).unwrap();
    /// let [ahead, back] = [0.0, std::f64::consts::PI]
    ///     .map(|azimuth| orbit.frequency_shift(std::f64::consts::FRAC_PI_2, azimuth));
    /// assert!((ahead - 3.0 / 2f64.sqrt()).abs() < 1e-12);
    /// assert!((back - 1.0 / 2f64.sqrt()).abs() < 1e-12);
    /// ```
    pub fn new(r: f64, motion: Motion) -> Result<Self, CoreError> {
        match motion {
            Motion::Rest => Observer::at(r).map(Self::from),
            Motion::Fall => Observer::falling(r).map(Self::from),
            Motion::Orbit if r.is_infinite() => Observer::at(r).map(Self::from),
            Motion::Orbit => Self::relative_to(Observer::at(r)?, 0.0, orbit_speed(r)?),
            Motion::Velocity { radial, tangential } => {
                let base = if r > 1.0 {
                    Observer::at(r)?
                } else {
                    Observer::falling(r)?
                };
                if base.is_at_infinity() {
                    return Err(CoreError::NoViewAngle);
                }
                Self::relative_to(base, radial, tangential)
            }
        }
    }

    /// The frame that moves relative to `base` at the velocity (`radial` outwards, `tangential`), in units of c.
    ///
    /// # Errors
    /// [`CoreError::Speed`] unless the speed is below 1.
    pub fn relative_to(base: Observer, radial: f64, tangential: f64) -> Result<Self, CoreError> {
        let speed = radial.hypot(tangential);
        if speed.is_nan() || speed >= 1.0 {
            return Err(CoreError::Speed(speed));
        }
        if speed == 0.0 {
            return Ok(Self::from(base));
        }
        if tangential == 0.0 {
            let doppler = ((1.0 - radial) / (1.0 + radial)).sqrt();
            return Ok(Self::from(base.boosted(doppler)));
        }
        Ok(MovingFrame {
            observer: base,
            boost: Some(Boost {
                direction: [-radial / speed, tangential / speed, 0.0],
                doppler: ((1.0 + speed) / (1.0 - speed)).sqrt(),
            }),
        })
    }

    /// The same frame as a boost relative to the observer at rest, or at the horizon and below to the one in free fall,
    /// even if the motion is radial.
    pub fn as_boost(&self) -> Self {
        let observer = &self.observer;
        let base = observer.base();
        let doppler = observer.redshifts()[1] / base.redshifts()[1];
        if self.boost.is_some() || (doppler - 1.0).abs() < 1e-15 {
            return *self;
        }
        MovingFrame {
            observer: base,
            boost: Some(Boost {
                direction: [1.0, 0.0, 0.0],
                doppler,
            }),
        }
    }

    /// The observer in radial motion relative to whom the boost is.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }

    /// The boost relative to [`MovingFrame::observer`]; `None` if the motion is radial.
    pub fn boost(&self) -> Option<Boost> {
        self.boost
    }

    /// The view direction at the angle `theta` from the direction of the hole and at `azimuth` about it (rad), as the
    /// observer in radial motion sees the same light. The azimuth stays within half a turn of the given one.
    pub fn unboosted(&self, theta: f64, azimuth: f64) -> UnboostedDirection {
        let Some(boost) = self.boost else {
            return UnboostedDirection {
                theta,
                azimuth,
                doppler: 1.0,
            };
        };
        let ((sin, cos), (across, along)) = (theta.sin_cos(), azimuth.sin_cos());
        let ([cos, along, across], doppler) = boost.unboosted([cos, sin * along, sin * across]);
        let turned = across.atan2(along) - azimuth;
        let turns = (turned / std::f64::consts::TAU).round();
        UnboostedDirection {
            theta: along.hypot(across).atan2(cos),
            azimuth: azimuth + (turned - turns * std::f64::consts::TAU),
            doppler,
        }
    }

    /// ν_obs/ν_∞ of light of the sky that is seen at the angle `theta` from the direction of the hole and at `azimuth`
    /// about it, rad. Infinite or negative where no light of the sky can come from.
    pub fn frequency_shift(&self, theta: f64, azimuth: f64) -> f64 {
        let seen = self.unboosted(theta, azimuth);
        seen.doppler * self.observer.frequency_shift(seen.theta)
    }
}

impl From<Observer> for MovingFrame {
    fn from(observer: Observer) -> Self {
        MovingFrame {
            observer,
            boost: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn falling(r: f64) -> Observer {
        Observer::falling(r).unwrap()
    }

    /// Angular radius of the shadow of the observer in free fall, degrees, computed independently of this project.
    #[test]
    fn the_shadow_of_the_falling_observer_has_its_known_radius() {
        for (r, degrees) in [
            (10.0, 10.310_109),
            (3.0, 24.203_428),
            (1.5, 35.264_390),
            (1.0, 42.103_449),
            (0.5, 53.270_266),
            (0.1, 72.263_813),
        ] {
            let edge = falling(r).shadow_angle().to_degrees();
            assert!((edge - degrees).abs() < 6e-7, "r {r}: {edge}");
        }
        assert!((falling(1e-6).shadow_angle() - FRAC_PI_2).abs() < 1e-2);
    }

    /// θ′ of the observer in free fall, rad, computed independently of this project.
    #[test]
    fn the_falling_observer_sees_the_known_sky() {
        for (r, degrees, sky) in [
            (1.0, 90.0, 2.095_934_186_715_96),
            (1.0, 150.0, 2.872_836_912_436_42),
            (0.5, 60.0, 0.637_155_722_699_676),
            (0.5, 90.0, 2.199_610_059_431_48),
            (0.1, 90.0, 2.442_960_622_626_93),
            (3.0, 150.0, 2.803_460_309_541_40),
        ] {
            let theta = f64::to_radians(degrees);
            let bend = exact::bend(&falling(r).ray(theta).unwrap()).escaped();
            let found = theta - bend.unwrap();
            assert!((found - sky).abs() < 1e-13, "r {r} θ {degrees}: {found}");
        }
    }

    #[test]
    fn the_shift_of_the_falling_observer_is_known() {
        let at_horizon = falling(1.0);
        let edge = at_horizon.shadow_angle();
        assert!((at_horizon.frequency_shift(edge) - 31.0 / 8.0).abs() < 1e-12);
        assert!((at_horizon.frequency_shift(PI) - 0.5).abs() < 1e-15);
        for r in [1e-3, 0.5, 1.0, 7.0, 1e9] {
            assert!((falling(r).frequency_shift(FRAC_PI_2) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn impossible_motions_are_refused() {
        use Motion::{Fall, Orbit, Rest, Velocity};
        let velocity = |radial, tangential| Velocity { radial, tangential };
        for (r, motion) in [
            (1.0, Rest),
            (0.5, Rest),
            (1e-7, Fall),
            (f64::NAN, Fall),
            (1.5, Orbit),
            (0.5, Orbit),
            (10.0, velocity(0.8, 0.6)),
            (10.0, velocity(f64::NAN, 0.0)),
            (10.0, velocity(0.0, -1.0)),
            (f64::INFINITY, velocity(0.1, 0.0)),
        ] {
            assert!(MovingFrame::new(r, motion).is_err(), "{r} {motion:?}");
        }
        assert!(MovingFrame::new(0.5, velocity(0.5, 0.5)).is_ok());
    }

    fn unit(theta: f64, azimuth: f64) -> [f64; 3] {
        [
            theta.cos(),
            theta.sin() * azimuth.cos(),
            theta.sin() * azimuth.sin(),
        ]
    }

    proptest! {
        #[test]
        fn a_radial_motion_is_also_a_boost(log_r in -3.0..8.0f64, theta in 0.01..3.13, log_k in -2.0..2.0f64) {
            let frame = MovingFrame::from(falling(log_r.exp()).boosted(log_k.exp()));
            let boosted = frame.as_boost();
            let (shift, other) = (frame.frequency_shift(theta, 0.3), boosted.frequency_shift(theta, 0.3));
            prop_assert!((shift - other).abs() <= 1e-9 * shift.abs().max(shift * shift), "{shift} {other}");
            let x = boosted.observer().shadow_coordinate(boosted.unboosted(theta, 0.3).theta).x;
            prop_assert!((x / frame.observer().shadow_coordinate(theta).x - 1.0).abs() < 1e-9);
        }

        /// The free fall is a boost of the observer at rest: the same sky at the aberrated angle, and shifts that differ
        /// by the Doppler factor.
        #[test]
        fn the_fall_is_a_boost_of_the_observer_at_rest(log_r in 0.01..10.0f64, theta in 0.01..3.1) {
            let r = log_r.exp();
            let (rest, fall) = (Observer::at(r).unwrap(), falling(r));
            let speed = (1.0 / r).sqrt();
            let boost = Boost { direction: [1.0, 0.0, 0.0], doppler: ((1.0 + speed) / (1.0 - speed)).sqrt() };
            let ([cos, sin, _], g) = boost.unboosted(unit(theta, 0.0));
            let at_rest = sin.atan2(cos);
            let shift = g / rest.lapse();
            prop_assert!((fall.frequency_shift(theta) / shift - 1.0).abs() < 1e-9);
            let (x, other) = (fall.shadow_coordinate(theta), rest.shadow_coordinate(at_rest));
            prop_assert!((x.x / other.x - 1.0).abs() < 1e-9);
            if x.one_minus_x > 1e-3 {
                let sky = |observer: Observer, theta: f64| {
                    theta - exact::bend(&observer.ray(theta).unwrap()).escaped().unwrap()
                };
                prop_assert!((sky(fall, theta) - sky(rest, at_rest)).abs() < 1e-10);
            }
        }

        /// b = r g sin θ for light of the sky, in every radial motion.
        #[test]
        fn the_impact_parameter_follows_from_the_shift(log_r in -4.5..4.0f64, theta in 0.01..3.1, log_k in -2.0..2.0f64) {
            let observer = falling(log_r.exp()).boosted(log_k.exp());
            let shift = observer.frequency_shift(theta);
            if shift > 0.0 {
                let b = log_r.exp() * shift * theta.sin();
                let found = observer.ray(theta).unwrap().impact_parameter();
                prop_assert!((found / b - 1.0).abs() < 1e-9 * shift.max(1.0), "{found} {b}");
            } else {
                prop_assert!(observer.shadow_coordinate(theta).one_minus_x <= 0.0);
            }
        }
    }
}
