//! Observers in motion: the aberration of view directions and the frequency shift.
//!
//! A radial motion changes only the shadow's angular radius and the view angle: it is part of the [`Observer`]. Any other
//! motion is a boost relative to an observer at rest (below the horizon, to the observer in free fall). A boost maps the
//! sphere of view directions conformally: with k = √((1+β)/(1−β)), it scales the stereographic coordinate tan(α/2) by k,
//! α being the angle from the direction of motion. In components, with c = cos α and n⊥ the part of the unit view
//! direction perpendicular to the motion,
//!
//! ```text
//! g = 2 / ((1+c)/k + k(1−c)),     n⊥ → g n⊥,     c → g ((1+c)/k − k(1−c)) / 2
//! ```
//!
//! maps the moving observer's direction to the other's; g is the ratio of the frequencies (moving over other), and the
//! factor by which the map scales small angles. It contains no 1 − β², so that it stays accurate at any speed.

use crate::geodesic::orbit_speed;
use crate::{CoreError, Observer};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// How an observer moves. Velocities are in units of c.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Motion {
    /// At rest: at a fixed radius above the horizon.
    #[default]
    Rest,
    /// In free fall from rest at infinity, at any radius.
    Fall,
    /// On the circular orbit at a radius above 3/2.
    Orbit,
    /// At this velocity relative to the observer at rest; at the horizon and below, relative to the observer in free
    /// fall.
    Velocity {
        /// Radial part, positive outwards.
        radial: f64,
        /// Part perpendicular to the radius.
        tangential: f64,
    },
}

/// A text that is no [`Motion`].
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "must be rest, fall, orbit, or a velocity BR,BT in units of c, such as -0.5,0.3, of a speed below 1"
)]
pub struct ParseMotionError;

impl FromStr for Motion {
    type Err = ParseMotionError;

    /// Parses `rest`, `fall`, `orbit` or `BR,BT`: the radial part of a velocity, positive outwards, and the tangential
    /// part.
    fn from_str(text: &str) -> Result<Self, ParseMotionError> {
        match text {
            "rest" => return Ok(Motion::Rest),
            "fall" => return Ok(Motion::Fall),
            "orbit" => return Ok(Motion::Orbit),
            _ => {}
        }
        let (radial, tangential) = text.split_once(',').ok_or(ParseMotionError)?;
        let number = |text: &str| text.trim().parse::<f64>().map_err(|_| ParseMotionError);
        let (radial, tangential) = (number(radial)?, number(tangential)?);
        if radial.hypot(tangential) < 1.0 {
            Ok(Motion::Velocity { radial, tangential })
        } else {
            Err(ParseMotionError)
        }
    }
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Motion::Rest => f.write_str("rest"),
            Motion::Fall => f.write_str("fall"),
            Motion::Orbit => f.write_str("orbit"),
            Motion::Velocity { radial, tangential } => write!(f, "{radial},{tangential}"),
        }
    }
}

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

    #[test]
    fn a_motion_is_read_from_its_text() {
        let velocity = |radial, tangential| Ok(Motion::Velocity { radial, tangential });
        assert_eq!("fall".parse(), Ok(Motion::Fall));
        assert_eq!("-0.5,0.3".parse(), velocity(-0.5, 0.3));
        assert_eq!("0, 0.99995".parse(), velocity(0.0, 0.99995));
        for motion in [Motion::Rest, Motion::Orbit] {
            assert_eq!(motion.to_string().parse(), Ok(motion));
        }
        for text in [
            "", "Fall", "0.5", "1,0", "0.8,0.6", "NaN,0", "0,0,0", "inf,0",
        ] {
            assert_eq!(text.parse::<Motion>(), Err(ParseMotionError), "{text}");
        }
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
        fn a_radial_motion_is_also_a_boost(log_r in -3.0..8.0f64, theta in 0.01..3.13, log_k in -2.0..2.0f64) {
            let frame = MovingFrame::from(falling(log_r.exp()).boosted(log_k.exp()));
            let boosted = frame.as_boost();
            let (shift, other) = (frame.frequency_shift(theta, 0.3), boosted.frequency_shift(theta, 0.3));
            prop_assert!((shift - other).abs() <= 1e-9 * shift.abs().max(shift * shift), "{shift} {other}");
            let x = boosted.observer().shadow_coordinate(boosted.unboosted(theta, 0.3).theta).x;
            prop_assert!((x / frame.observer().shadow_coordinate(theta).x - 1.0).abs() < 1e-9);
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
