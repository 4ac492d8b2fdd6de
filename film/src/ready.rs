//! Ready paths, made of ordinary keyframes.

use crate::{Ends, FlightPath, Keyframe, KeyframeMotion};
use lensbake_core::geodesic::{fall_time, orbit_rate, orbit_speed};
use std::f64::consts::TAU;
use thiserror::Error;

/// A ready path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReadyPath {
    /// Once round the hole on the circular geodesic, looking at the hole.
    Orbit,
    /// The free fall through the horizon, looking at the hole first and then to the side.
    Fall,
    /// Past the hole on a straight line, looking at it.
    Flyby,
    /// From afar down to the horizon at rest, looking at the hole first and back at the end.
    Dive,
}

/// A radius that a ready path cannot have.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "{radius} is not above {least} and at most {MAX_READY_RADIUS}, as the path {name} needs it"
)]
pub struct ReadyPathError {
    /// The radius.
    pub radius: f64,
    /// Name of the path.
    pub name: &'static str,
    /// Its radius must be above this.
    pub least: f64,
}

/// Largest radius of a ready path: from farther away the hole is but a point.
const MAX_READY_RADIUS: f64 = 1000.0;
/// Where the ready fall ends.
const FALL_TO: f64 = 0.05;
/// Proper time passes this much slower at the end of the ready fall, when r changes fast, than at its beginning.
const SLOWER: f64 = 12.0;
/// Where the ready dive ends.
const DIVE_TO: f64 = 1.1;
/// Half the length of the way past the hole, in units of the least distance.
const FLYBY_REACH: f64 = 6.0;

impl ReadyPath {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            ReadyPath::Orbit => "orbit",
            ReadyPath::Fall => "fall",
            ReadyPath::Flyby => "flyby",
            ReadyPath::Dive => "dive",
        }
    }

    /// The radius that it has unless the user names another: of the orbit, where the fall and the dive begin, or the least
    /// of the flyby.
    pub fn default_radius(self) -> f64 {
        match self {
            ReadyPath::Orbit => 10.0,
            ReadyPath::Fall => 6.0,
            ReadyPath::Flyby => 3.0,
            ReadyPath::Dive => 40.0,
        }
    }

    /// Its radius must be above this.
    fn least_radius(self) -> f64 {
        match self {
            ReadyPath::Orbit => lensbake_core::R_PHOTON,
            ReadyPath::Fall => FALL_TO,
            ReadyPath::Flyby => 1.0,
            ReadyPath::Dive => DIVE_TO,
        }
    }

    /// The path, with a `radius` as [`ReadyPath::default_radius`] explains it, in a film of `seconds`.
    ///
    /// # Errors
    /// [`ReadyPathError`] if the path cannot have this radius.
    pub fn path(self, radius: f64, seconds: f64) -> Result<FlightPath, ReadyPathError> {
        let refused = ReadyPathError {
            radius,
            name: self.name(),
            least: self.least_radius(),
        };
        if !(radius > refused.least && radius <= MAX_READY_RADIUS) {
            return Err(refused);
        }
        Ok(match self {
            ReadyPath::Orbit => orbit(radius, seconds).map_err(|_| refused)?,
            ReadyPath::Fall => fall(radius, seconds),
            ReadyPath::Flyby => flyby(radius, seconds),
            ReadyPath::Dive => dive(radius, seconds),
        })
    }
}

/// One period of the orbit. Aberration moves the hole to the side, by the arcsine of the speed; the yaw follows it.
fn orbit(radius: f64, seconds: f64) -> Result<FlightPath, lensbake_core::CoreError> {
    let period = TAU / orbit_rate(radius)?;
    let start = Keyframe {
        motion: Some(KeyframeMotion::Orbit),
        radius: Some(radius),
        yaw: Some(orbit_speed(radius)?.asin().to_degrees()),
        fov: Some(90.0),
        clock_rate: Some(period / seconds),
        ..Keyframe::default()
    };
    Ok(steady(vec![start, at(seconds)]))
}

fn fall(radius: f64, seconds: f64) -> FlightPath {
    let proper_time = fall_time(radius) - fall_time(FALL_TO);
    let mean_rate = proper_time / seconds;
    let last_rate = 2.0 * mean_rate / (1.0 + SLOWER);
    let start = Keyframe {
        motion: Some(KeyframeMotion::Fall),
        radius: Some(radius),
        yaw: Some(0.0),
        fov: Some(110.0),
        clock_rate: Some(SLOWER * last_rate),
        ..Keyframe::default()
    };
    let turning = Keyframe {
        yaw: Some(0.0),
        ..at(0.3 * seconds)
    };
    let end = Keyframe {
        yaw: Some(75.0),
        clock_rate: Some(last_rate),
        ..at(seconds)
    };
    FlightPath {
        ends: Ends::Gentle,
        keyframes: vec![start, turning, end],
    }
}

/// On a straight line at constant speed: the radius and the longitude of nine places on it.
fn flyby(least: f64, seconds: f64) -> FlightPath {
    const PLACES: i32 = 4;
    let keyframes = (-PLACES..=PLACES).map(|i| {
        let part = f64::from(i) / f64::from(PLACES);
        let along = FLYBY_REACH * part;
        Keyframe {
            radius: Some(least * along.hypot(1.0)),
            orbit: Some(along.atan().to_degrees()),
            fov: (i == -PLACES).then_some(90.0),
            ..at(0.5 * (1.0 + part) * seconds)
        }
    });
    steady(keyframes.collect())
}

fn dive(radius: f64, seconds: f64) -> FlightPath {
    let start = Keyframe {
        radius: Some(radius),
        yaw: Some(0.0),
        fov: Some(100.0),
        ..Keyframe::default()
    };
    let turning = Keyframe {
        yaw: Some(0.0),
        ..at(0.4 * seconds)
    };
    let end = Keyframe {
        radius: Some(DIVE_TO),
        yaw: Some(180.0),
        ..at(seconds)
    };
    FlightPath {
        ends: Ends::Gentle,
        keyframes: vec![start, turning, end],
    }
}

fn steady(keyframes: Vec<Keyframe>) -> FlightPath {
    FlightPath {
        ends: Ends::Steady,
        keyframes,
    }
}

/// A keyframe that names only its time.
fn at(time: f64) -> Keyframe {
    Keyframe {
        time,
        ..Keyframe::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Flight;

    const ALL: [ReadyPath; 4] = [
        ReadyPath::Orbit,
        ReadyPath::Fall,
        ReadyPath::Flyby,
        ReadyPath::Dive,
    ];

    fn flight(path: ReadyPath, radius: f64, seconds: f64) -> Flight {
        Flight::new(&path.path(radius, seconds).unwrap()).unwrap()
    }

    fn radius(flight: &Flight, time: f64) -> f64 {
        flight.shot(time, (64, 36)).view.radius
    }

    #[test]
    fn they_last_as_long_as_they_should_and_are_read_back() {
        for ready in ALL {
            let path = ready.path(ready.default_radius(), 7.0).unwrap();
            assert_eq!(Flight::new(&path).unwrap().seconds(), 7.0);
            assert_eq!(path.to_json().parse(), Ok(path));
        }
    }

    #[test]
    fn they_go_where_they_should() {
        let orbit = flight(ReadyPath::Orbit, 10.0, 8.0);
        let longitude = |time| orbit.shot(time, (64, 36)).view.orbit_deg;
        assert!((longitude(2.0) - 90.0).abs() < 1e-9 && (longitude(6.0) + 90.0).abs() < 1e-9);
        assert!(longitude(8.0).abs() < 1e-9);
        let fall = flight(ReadyPath::Fall, 6.0, 8.0);
        assert!((radius(&fall, 0.0) - 6.0).abs() < 1e-12);
        assert!((radius(&fall, 8.0) / FALL_TO - 1.0).abs() < 1e-9);
        let flyby = flight(ReadyPath::Flyby, 3.0, 8.0);
        assert!((radius(&flyby, 4.0) - 3.0).abs() < 1e-12);
        assert!(
            radius(&flyby, 0.0) > 15.0 && (radius(&flyby, 1.0) - radius(&flyby, 7.0)).abs() < 1e-9
        );
        let dive = flight(ReadyPath::Dive, 40.0, 8.0);
        assert!(
            (radius(&dive, 0.0) - 40.0).abs() < 1e-9
                && (radius(&dive, 8.0) - DIVE_TO).abs() < 1e-12
        );
    }

    #[test]
    fn radii_that_a_path_cannot_have_are_refused() {
        for ready in ALL {
            for radius in [ready.least_radius(), -1.0, f64::NAN, 1001.0, f64::INFINITY] {
                let said = ready.path(radius, 5.0).unwrap_err().to_string();
                assert!(said.contains(ready.name()), "{said}");
            }
            assert!(Flight::new(&ready.path(ready.least_radius() * 1.001, 5.0).unwrap()).is_ok());
        }
    }
}
