//! A checked path: where the camera is, and what it shows, at each time.

use crate::curve::Curve;
use crate::error::MAX_TIME;
use crate::leg::{self, Leg};
use crate::orientation::Orientation;
use crate::{Channel, FlightPath, PathError};
use lensbake_render::camera::{Projection, View};

/// A flight. What it returns for a time does not depend on what was asked before.
#[derive(Debug, Clone, PartialEq)]
pub struct Flight {
    yaw: Curve,
    pitch: Curve,
    roll: Curve,
    fov: Curve,
    exposure: Curve,
    sky_turn: Curve,
    clock: Curve,
    legs: Vec<Leg>,
    seconds: f64,
}

/// What a camera shows at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shot {
    /// The view. The turn of the sky is in its longitude: only their difference shows.
    pub view: View,
    /// Exposure, stops.
    pub exposure: f64,
}

impl Flight {
    /// The flight along `path`.
    ///
    /// # Errors
    /// [`PathError`] names the keyframe and the field that is wrong: times that do not grow, values out of range or not
    /// finite, a radius at which the motion is not possible, a place that follows from physics.
    pub fn new(path: &FlightPath) -> Result<Self, PathError> {
        check_times(path)?;
        check_values(path)?;
        let channel = |channel: Channel| leg::curve(path, &nodes(path, channel));
        let clock = channel(Channel::ClockRate);
        Ok(Flight {
            yaw: channel(Channel::Yaw),
            pitch: channel(Channel::Pitch),
            roll: channel(Channel::Roll),
            fov: channel(Channel::Fov),
            exposure: channel(Channel::Exposure),
            sky_turn: channel(Channel::SkyTurn),
            legs: leg::legs(path, &clock)?,
            clock,
            seconds: path.keyframes.last().map_or(0.0, |last| last.time),
        })
    }

    /// Time of the last keyframe, s.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// The shot at `time` (s), in a picture of this size. After the last keyframe what is interpolated stays, and an orbit
    /// or a fall goes on; a fall stops at [`FALL_END`](lensbake_render::camera::FALL_END).
    pub fn shot(&self, time: f64, size: (u32, u32)) -> Shot {
        self.shot_during(time, time, size)
    }

    /// As [`Flight::shot`], but in the motion that the camera has at the time `during`: the moments of one exposure do not
    /// reach over a cut.
    pub fn shot_during(&self, during: f64, time: f64, (width, height): (u32, u32)) -> Shot {
        let begun = self.legs.partition_point(|leg| leg.start <= during);
        let leg = &self.legs[begun.saturating_sub(1)];
        let position = leg.position(time, &self.clock);
        let orientation = Orientation {
            yaw_deg: self.yaw.at(time),
            pitch_deg: self.pitch.at(time),
            roll_deg: self.roll.at(time),
        };
        let Orientation {
            yaw_deg,
            pitch_deg,
            roll_deg,
        } = orientation.turned(position.turn_deg);
        let view = View {
            radius: position.radius,
            motion: leg.motion.into(),
            heading_deg: position.place.heading_deg,
            orbit_deg: position.place.longitude_deg - self.sky_turn.at(time),
            latitude_deg: position.place.latitude_deg,
            yaw_deg,
            pitch_deg,
            roll_deg,
            projection: Projection::Perspective,
            fov_deg: self.fov.at(time),
            width,
            height,
        };
        Shot {
            view,
            exposure: self.exposure.at(time),
        }
    }
}

/// The values of `channel` that keyframes name, with their times; that of the first keyframe is the default if it names
/// none.
fn nodes(path: &FlightPath, channel: Channel) -> Vec<(f64, f64)> {
    let numbered = path.keyframes.iter().enumerate();
    let nodes = numbered.filter_map(|(index, keyframe)| {
        let default = (index == 0).then(|| channel.default_value());
        Some((keyframe.time, channel.of(keyframe).or(default)?))
    });
    nodes.collect()
}

fn check_times(path: &FlightPath) -> Result<(), PathError> {
    if path.keyframes.is_empty() {
        return Err(PathError::NoKeyframes);
    }
    for (index, keyframe) in path.keyframes.iter().enumerate() {
        let time = keyframe.time;
        if !(0.0..=MAX_TIME).contains(&time) {
            return Err(PathError::Time { index, time });
        }
        let before = index
            .checked_sub(1)
            .map(|before| path.keyframes[before].time);
        match before {
            Some(before) if time == before => return Err(PathError::SameTime { index, time }),
            Some(before) if time < before => {
                return Err(PathError::TimeNotAfter {
                    index,
                    time,
                    before,
                });
            }
            _ => {}
        }
    }
    Ok(())
}

fn check_values(path: &FlightPath) -> Result<(), PathError> {
    for (index, keyframe) in path.keyframes.iter().enumerate() {
        for channel in Channel::ALL {
            let checked = channel
                .of(keyframe)
                .map_or(Ok(()), |value| channel.check(value));
            checked.map_err(|problem| PathError::Keyframe {
                index,
                field: channel.name(),
                problem,
            })?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_core::Motion;
    use lensbake_core::geodesic::{fall_time, orbit_rate};
    use lensbake_render::camera::{Camera, FALL_END};

    fn flight(keyframes: &str) -> Result<Flight, PathError> {
        Flight::new(&format!(r#"{{"keyframes": [{keyframes}]}}"#).parse()?)
    }

    #[track_caller]
    fn flies(keyframes: &str) -> Flight {
        flight(keyframes).unwrap()
    }

    fn view(flight: &Flight, time: f64) -> View {
        flight.shot(time, (64, 36)).view
    }

    #[track_caller]
    fn near(found: f64, known: f64) {
        assert!(
            (found - known).abs() < 1e-9 * known.abs().max(1.0),
            "{found} {known}"
        );
    }

    #[test]
    fn a_channel_goes_through_the_keyframes_that_name_it() {
        let flight = flies(
            r#"{"time": 0, "radius": 26, "yaw": 350, "fov": 60}, {"time": 1, "fov": 80}, {"time": 2, "radius": 2, "yaw": 370}, {"time": 4, "pitch": 8, "exposure": 2, "sky_turn": 30}"#,
        );
        let middle = view(&flight, 1.0);
        // Halfway in ln(r − 1), and in an angle that goes on beyond 360.
        near(middle.radius, 6.0);
        near(middle.yaw_deg, 360.0);
        near(middle.fov_deg, 80.0);
        let end = flight.shot(9.0, (64, 36));
        near(end.view.radius, 2.0);
        near(end.view.pitch_deg, 8.0);
        near(end.view.orbit_deg, -30.0);
        near(end.exposure, 2.0);
        near(flight.shot(2.0, (64, 36)).exposure, 1.0);
        assert_eq!((end.view.width, end.view.height), (64, 36));
        assert_eq!(end.view.motion, Motion::Rest);
    }

    #[test]
    fn a_fall_follows_its_clock_and_goes_on_from_where_it_is() {
        let flight = flies(
            r#"{"time": 0, "radius": 20}, {"time": 2, "radius": 6, "motion": "fall", "clock_rate": 0.5}, {"time": 3, "yaw": 20}, {"time": 6, "motion": "fall"}"#,
        );
        near(view(&flight, 2.0).radius, 6.0);
        assert_eq!(view(&flight, 1.999).motion, Motion::Rest);
        assert_eq!(view(&flight, 2.0).motion, Motion::Fall);
        // The clock goes from 1 to 0.5 gently: its mean rate until t = 2 is not that after it.
        for time in [3.0, 5.0, 6.0, 9.0] {
            let passed = fall_time(6.0) - fall_time(view(&flight, time).radius);
            near(passed, 0.5 * (time - 2.0));
        }
        assert_eq!(view(&flight, 1e5).radius, FALL_END);
    }

    #[test]
    fn an_orbit_takes_its_period_and_stops_where_it_is() {
        let flight = flies(
            r#"{"time": 0, "radius": 6, "motion": "orbit", "orbit": 350, "clock_rate": 3}, {"time": 5, "motion": "rest"}, {"time": 7, "radius": 9}"#,
        );
        let turned = (orbit_rate(6.0).unwrap() * 3.0 * 5.0).to_degrees();
        near(
            (view(&flight, 5.0).orbit_deg - 350.0 - turned).rem_euclid(360.0) % 360.0,
            0.0,
        );
        near(view(&flight, 4.9).radius, 6.0);
        near(view(&flight, 7.0).radius, 9.0);
        assert_eq!(view(&flight, 6.0).orbit_deg, view(&flight, 5.0).orbit_deg);
    }

    /// Over the pole longitude and heading jump, but the sky that a camera sees does not.
    #[test]
    fn an_orbit_over_the_pole_does_not_turn_the_picture_over() {
        let flight = flies(
            r#"{"time": 0, "radius": 6, "motion": "orbit", "heading": 90, "latitude": 60, "yaw": 20, "pitch": 5, "roll": 3}"#,
        );
        let axes = |time| {
            let camera = Camera::new(&view(&flight, time)).unwrap();
            [camera.forward, camera.right.normalize()].map(|v| camera.sky_from_hole * v)
        };
        let mut jumped = false;
        for frame in 0..200 {
            let (time, next) = (0.1 * f64::from(frame), 0.1 * f64::from(frame + 1));
            let turned = orbit_rate(6.0).unwrap() * 0.1;
            for (a, b) in axes(time).into_iter().zip(axes(next)) {
                assert!((a - b).length() < 1.01 * turned, "{time}");
            }
            jumped |= (view(&flight, time).orbit_deg - view(&flight, next).orbit_deg).abs() > 90.0;
        }
        assert!(jumped, "the test goes over no pole");
    }

    #[test]
    fn an_exposure_does_not_reach_over_a_cut() {
        let flight = flies(
            r#"{"time": 0, "radius": 6, "motion": "fall"}, {"time": 1, "radius": 9, "motion": "rest"}"#,
        );
        let shot = |during, time| flight.shot_during(during, time, (64, 36)).view;
        assert_eq!(shot(1.0, 0.99).motion, Motion::Rest);
        near(shot(1.0, 0.99).radius, 9.0);
        assert_eq!(shot(0.99, 1.01).motion, Motion::Fall);
        assert!(
            shot(0.0, -0.1).radius > 6.0,
            "the fall has begun before the film"
        );
    }

    #[test]
    fn what_cannot_be_flown_is_refused() {
        for (keyframes, words) in [
            ("", &["keyframes: the path has none"][..]),
            (
                r#"{"time": 1}, {"time": 1}"#,
                &["keyframes[1].time", "two keyframes are at 1"],
            ),
            (
                r#"{"time": 1}, {"time": 0.5}"#,
                &["keyframes[1].time", "0.5 is not after 1"],
            ),
            (r#"{"time": -1}"#, &["keyframes[0].time", "-1"]),
            (
                r#"{"time": 0, "radius": 1}"#,
                &["keyframes[0].radius", "horizon"],
            ),
            (
                r#"{"time": 0, "radius": 1e7}"#,
                &["keyframes[0].radius", "too far"],
            ),
            (
                r#"{"time": 0}, {"time": 1, "radius": 0.5}"#,
                &["keyframes[1].radius", "horizon"],
            ),
            (
                r#"{"time": 0}, {"time": 1, "radius": 0.5, "motion": "fall"}"#,
                &["keyframes[1].radius", "horizon"],
            ),
            (
                r#"{"time": 0, "radius": 1.4, "motion": "orbit"}"#,
                &["keyframes[0].radius", "1.5"],
            ),
            (
                r#"{"time": 0, "radius": 0.005, "motion": "fall"}"#,
                &["keyframes[0].radius", "0.01"],
            ),
            (r#"{"time": 0, "fov": 180}"#, &["keyframes[0].fov", "180"]),
            (
                r#"{"time": 0, "exposure": 40}"#,
                &["keyframes[0].exposure", "from -32 to 32"],
            ),
            (
                r#"{"time": 0, "clock_rate": -1}"#,
                &["keyframes[0].clock_rate", "from 0"],
            ),
            (
                r#"{"time": 0, "radius": 6, "motion": "fall"}, {"time": 1, "radius": 3}"#,
                &["keyframes[1].radius", "motion fall of keyframes[0]"],
            ),
            (
                r#"{"time": 0, "motion": "orbit"}, {"time": 1, "latitude": 3}"#,
                &["keyframes[1].latitude", "motion orbit"],
            ),
            (
                r#"{"time": 0, "radius": 2, "motion": "fall"}, {"time": 9, "motion": "rest"}"#,
                &["keyframes[1].radius", "gets here at the radius 0.01"],
            ),
        ] {
            let said = flight(keyframes).unwrap_err().to_string();
            for word in words {
                assert!(said.contains(word), "no '{word}' in: {said}");
            }
        }
        for value in [f64::NAN, f64::INFINITY] {
            for channel in Channel::ALL {
                let mut path = FlightPath {
                    keyframes: vec![Default::default()],
                    ..Default::default()
                };
                channel.set(&mut path.keyframes[0], value);
                let said = Flight::new(&path).unwrap_err().to_string();
                assert!(said.contains(channel.name()), "{said}");
            }
        }
    }
}
