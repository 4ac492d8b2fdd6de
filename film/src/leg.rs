//! The legs of a flight: the parts in which one motion moves the camera.

use crate::channel::check_radius;
use crate::curve::{Curve, EndSlope};
use crate::{Channel, Ends, FlightPath, KeyframeError, KeyframeMotion, PathError};
use lensbake_core::geodesic::{fall_radius, fall_time, orbit_rate};
use lensbake_render::camera::{FALL_END, Place};

/// Where the camera is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Position {
    pub(crate) radius: f64,
    pub(crate) place: Place,
    /// How far an orbit has turned the direction of motion, from east towards north. The camera turns with it, so that an
    /// orbit over a pole does not turn the picture over.
    pub(crate) turn_deg: f64,
}

/// A leg.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Leg {
    pub(crate) motion: KeyframeMotion,
    /// Time of its first keyframe, s.
    pub(crate) start: f64,
    /// Where it begins.
    from: Position,
    way: Way,
}

#[derive(Debug, Clone, PartialEq)]
enum Way {
    /// Through the keyframes: the curves of [`Channel::PLACE`], of the radius that of ln(r − 1).
    Carried([Curve; 4]),
    /// Along the great circle of the heading, at this angle per proper time, rad c/r_s.
    Orbit(f64),
    /// Towards the hole.
    Fall,
}

impl Leg {
    /// Where the camera is at `time`, if proper time passes at the rate `clock`.
    pub(crate) fn position(&self, time: f64, clock: &Curve) -> Position {
        let proper_time = || clock.integral(self.start, time);
        match &self.way {
            Way::Carried(curves) => {
                let [height, longitude_deg, latitude_deg, heading_deg] =
                    curves.each_ref().map(|curve| curve.at(time));
                let place = Place {
                    longitude_deg,
                    latitude_deg,
                    heading_deg,
                };
                Position {
                    radius: 1.0 + height.exp(),
                    place,
                    ..self.from
                }
            }
            Way::Orbit(rate) => {
                let place = self.from.place.moved(rate * proper_time());
                let turned = place.heading_deg - self.from.place.heading_deg;
                Position {
                    place,
                    turn_deg: self.from.turn_deg + turned,
                    ..self.from
                }
            }
            Way::Fall => {
                let left = fall_time(self.from.radius) - proper_time();
                Position {
                    radius: fall_radius(left.max(fall_time(FALL_END))).max(FALL_END),
                    ..self.from
                }
            }
        }
    }
}

/// The legs of a path whose times and values are checked, apart from the radii.
pub(crate) fn legs(path: &FlightPath, clock: &Curve) -> Result<Vec<Leg>, PathError> {
    let starts = starts(path);
    let mut legs: Vec<Leg> = Vec::with_capacity(starts.len());
    for (i, &(first, motion)) in starts.iter().enumerate() {
        let next = starts.get(i + 1).map(|&(next, _)| next);
        let time = path.keyframes[first].time;
        let arrival = legs.last().map(|leg| leg.position(time, clock));
        let from = departure(path, first, motion, arrival)?;
        let way = match motion {
            KeyframeMotion::Rest => carried(path, first, next, from)?,
            KeyframeMotion::Orbit | KeyframeMotion::Fall => {
                by_physics(path, first, next, motion, from)?
            }
        };
        legs.push(Leg {
            motion,
            start: time,
            from,
            way,
        });
    }
    Ok(legs)
}

/// The keyframe at which each leg begins, and its motion.
fn starts(path: &FlightPath) -> Vec<(usize, KeyframeMotion)> {
    let mut starts: Vec<(usize, KeyframeMotion)> = Vec::new();
    for (index, keyframe) in path.keyframes.iter().enumerate() {
        let before = starts.last().map(|&(_, motion)| motion);
        match (keyframe.motion, before) {
            (motion, None) => starts.push((index, motion.unwrap_or_default())),
            (Some(KeyframeMotion::Rest), Some(KeyframeMotion::Rest)) | (None, _) => {}
            (Some(motion), _) => starts.push((index, motion)),
        }
    }
    starts
}

/// Where the leg from the keyframe `first` begins: at what it names, otherwise where the leg before has arrived.
fn departure(
    path: &FlightPath,
    first: usize,
    motion: KeyframeMotion,
    arrival: Option<Position>,
) -> Result<Position, PathError> {
    let keyframe = &path.keyframes[first];
    let place = arrival.map(|arrival| arrival.place);
    let value = |channel: Channel, arrived: Option<f64>| {
        let named = channel.of(keyframe);
        named.or(arrived).unwrap_or(channel.default_value())
    };
    let names_place = Channel::PLACE
        .iter()
        .any(|channel| channel.of(keyframe).is_some());
    let radius = value(Channel::Radius, arrival.map(|arrival| arrival.radius));
    check_radius(radius, motion).map_err(|problem| {
        let problem = match keyframe.radius {
            None if arrival.is_some() => KeyframeError::ArrivesTooLow { radius, motion },
            _ => problem,
        };
        at(first, Channel::Radius, problem)
    })?;
    Ok(Position {
        radius,
        place: Place {
            longitude_deg: value(Channel::Orbit, place.map(|place| place.longitude_deg)),
            latitude_deg: value(Channel::Latitude, place.map(|place| place.latitude_deg)),
            heading_deg: value(Channel::Heading, place.map(|place| place.heading_deg)),
        },
        // A keyframe that names a place also says how the camera is turned there.
        turn_deg: arrival
            .filter(|_| !names_place)
            .map_or(0.0, |arrival| arrival.turn_deg),
    })
}

/// The way from the keyframe `first` through those that follow, up to what the keyframe `next` names, where the next leg
/// begins.
fn carried(
    path: &FlightPath,
    first: usize,
    next: Option<usize>,
    from: Position,
) -> Result<Way, PathError> {
    let last = next.unwrap_or(path.keyframes.len() - 1);
    for (i, keyframe) in path.keyframes.iter().enumerate().take(last + 1).skip(first) {
        // The keyframe of the next leg is checked there, but this leg must be possible up to it.
        if let Some(radius) = keyframe.radius {
            let checked = check_radius(radius, KeyframeMotion::Rest);
            checked.map_err(|problem| at(i, Channel::Radius, problem))?;
        }
    }
    let start = [
        from.radius,
        from.place.longitude_deg,
        from.place.latitude_deg,
        from.place.heading_deg,
    ];
    let curves = std::array::from_fn(|i| {
        let channel = Channel::PLACE[i];
        let value = |value: f64| match channel {
            Channel::Radius => (value - 1.0).ln(),
            _ => value,
        };
        let mut nodes = vec![(path.keyframes[first].time, value(start[i]))];
        let later = path.keyframes[first + 1..=last].iter();
        nodes.extend(
            later.filter_map(|keyframe| Some((keyframe.time, value(channel.of(keyframe)?)))),
        );
        curve(path, &nodes)
    });
    Ok(Way::Carried(curves))
}

/// The way by physics from the keyframe `first`. Those that follow, before the keyframe `next`, name no place.
fn by_physics(
    path: &FlightPath,
    first: usize,
    next: Option<usize>,
    motion: KeyframeMotion,
    from: Position,
) -> Result<Way, PathError> {
    let end = next.unwrap_or(path.keyframes.len());
    for index in first + 1..end {
        let keyframe = &path.keyframes[index];
        let named = Channel::PLACE
            .into_iter()
            .find(|channel| channel.of(keyframe).is_some());
        if let Some(channel) = named {
            let since = first;
            let problem = KeyframeError::FollowsFromMotion { motion, since };
            return Err(at(index, channel, problem));
        }
    }
    match motion {
        KeyframeMotion::Orbit => orbit_rate(from.radius)
            .map(Way::Orbit)
            .map_err(|problem| at(first, Channel::Radius, problem.into())),
        KeyframeMotion::Fall | KeyframeMotion::Rest => Ok(Way::Fall),
    }
}

fn at(index: usize, channel: Channel, problem: KeyframeError) -> PathError {
    PathError::Keyframe {
        index,
        field: channel.name(),
        problem,
    }
}

/// The curve through `nodes`, which starts and stops with the path as its [`Ends`] say, and elsewhere gently.
pub(crate) fn curve(path: &FlightPath, nodes: &[(f64, f64)]) -> Curve {
    let slope = |node: Option<&(f64, f64)>, keyframe: Option<&crate::Keyframe>| {
        let at_the_end = node.map(|node| node.0) == keyframe.map(|keyframe| keyframe.time);
        match path.ends {
            Ends::Steady if at_the_end => EndSlope::Secant,
            Ends::Steady | Ends::Gentle => EndSlope::Still,
        }
    };
    let ends = [
        slope(nodes.first(), path.keyframes.first()),
        slope(nodes.last(), path.keyframes.last()),
    ];
    Curve::new(nodes, ends)
}
