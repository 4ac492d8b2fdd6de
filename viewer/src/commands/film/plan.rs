//! What is to be filmed: the flight, and the times of the frames.

use super::FilmError;
use crate::cli::{FilmArgs, disc_fov_deg};
use lensbake_film::{FilmClock, Flight, FlightPath, FrameRange, ReadyPath, Shot, Shutter};
use lensbake_render::camera::{Projection, View};
use std::path::Path;
use std::sync::Arc;

/// Length of a film along a ready path unless the user names another, s.
const READY_SECONDS: f64 = 10.0;

/// What is to be filmed.
#[derive(Clone)]
pub(super) struct Plan {
    pub(super) path: Arc<FlightPath>,
    pub(super) clock: FilmClock,
    /// Numbers of the frames that the user asks for.
    pub(super) frames: Vec<u32>,
    flight: Arc<Flight>,
    shutter: Shutter,
    size: (u32, u32),
    projection: Projection,
    /// Field of view of all frames, instead of that of the path.
    fov_deg: Option<f64>,
}

impl Plan {
    /// The film as the arguments describe it, in perspective. A file of a path is read here, and only once: it may be a
    /// FIFO.
    pub(super) fn new(args: &FilmArgs) -> Result<Self, FilmError> {
        let shutter = Shutter::new(args.shutter, args.subframes)?;
        let (path, flight, seconds) = match (&args.file, args.path) {
            (Some(file), _) => from_file(file, args.seconds)?,
            (None, Some(name)) => ready(name.into(), args)?,
            (None, None) => unreachable!("one of the two is required"),
        };
        let clock = FilmClock::new(args.fps, seconds)?;
        let range = args.frames.unwrap_or(FrameRange::ALL);
        Ok(Plan {
            frames: range.within(clock.frames())?.collect(),
            path: Arc::new(path),
            clock,
            flight: Arc::new(flight),
            shutter,
            size: args.size(),
            projection: Projection::Perspective,
            fov_deg: args.fov,
        })
    }

    /// The same film in this projection.
    pub(super) fn seen_in(&self, projection: Projection) -> Self {
        Plan {
            projection,
            fov_deg: self.fov_deg.or(disc_fov_deg(projection)),
            ..self.clone()
        }
    }

    /// The shot of `frame`.
    pub(super) fn shot(&self, frame: u32) -> Shot {
        self.framed(self.flight.shot(self.clock.time(frame), self.size))
    }

    /// The shots at the moments of `frame` at which the shutter is open, with these moments, s.
    pub(super) fn moments(&self, frame: u32) -> impl Iterator<Item = (f64, Shot)> {
        let time = self.clock.time(frame);
        let times = self.shutter.times(time, self.clock.period());
        times.map(move |moment| {
            let shot = self.flight.shot_during(time, moment, self.size);
            (moment, self.framed(shot))
        })
    }

    /// The shot in the projection of the film.
    fn framed(&self, shot: Shot) -> Shot {
        let view = View {
            projection: self.projection,
            fov_deg: self.fov_deg.unwrap_or(shot.view.fov_deg),
            ..shot.view
        };
        Shot { view, ..shot }
    }
}

fn from_file(file: &Path, seconds: Option<f64>) -> Result<(FlightPath, Flight, f64), FilmError> {
    let (path, flight) = lensbake_film::read(file)?;
    let seconds = match seconds {
        None if flight.seconds() == 0.0 => return Err(FilmError::NoLength(file.to_owned())),
        seconds => seconds.unwrap_or(flight.seconds()),
    };
    Ok((path, flight, seconds))
}

fn ready(ready: ReadyPath, args: &FilmArgs) -> Result<(FlightPath, Flight, f64), FilmError> {
    let seconds = args.seconds.unwrap_or(READY_SECONDS);
    // Refused before the path is made, whose keyframes would have impossible times.
    FilmClock::new(args.fps, seconds)?;
    let radius = args.radius.unwrap_or(ready.default_radius());
    let path = ready.path(radius, seconds)?;
    let flight = Flight::new(&path)?;
    Ok((path, flight, seconds))
}
