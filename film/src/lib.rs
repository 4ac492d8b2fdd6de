//! Flights of a camera around a black hole, for films: a path of keyframes, where the camera is at each time, and the
//! numbers and names of the frames.
//!
//! A [`FlightPath`] is what a user writes (JSON), and what a program can record. A [`Flight`] is a checked path: it returns
//! the [`Shot`] at any time, in closed form, so that a frame depends on its number alone. The library reads no clock, draws
//! nothing and knows no command line.
//!
//! ```
//! use lensbake_film::{Flight, FlightPath};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let path: FlightPath = r#"{"keyframes": [{"time": 0, "radius": 25}, {"time": 4, "radius": 6}]}"#.parse()?;
//! let flight = Flight::new(&path)?;
//! assert!((flight.shot(4.0, (1920, 1080)).view.radius - 6.0).abs() < 1e-12);
//! # Ok(())
//! # }
//! ```

mod channel;
mod clock;
mod curve;
mod error;
mod file;
mod flight;
mod frame_names;
mod frame_range;
mod keyframe;
mod leg;
mod orientation;
mod parse;
mod ready;
mod shutter;

pub use channel::Channel;
pub use clock::{ClockError, FilmClock, FrameRate, FrameRateError, MAX_FRAMES};
pub use error::{KeyframeError, PathError};
pub use file::{PathFileError, PathFileProblem, read};
pub use flight::{Flight, Shot};
pub use frame_names::{FrameNames, FrameNamesError};
pub use frame_range::{FrameRange, FrameRangeError};
pub use keyframe::{Ends, FlightPath, Keyframe, KeyframeMotion};
pub use orientation::Orientation;
pub use ready::{ReadyPath, ReadyPathError};
pub use shutter::{Shutter, ShutterError};
