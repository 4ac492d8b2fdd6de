//! How an observer moves, as a user says it.

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
