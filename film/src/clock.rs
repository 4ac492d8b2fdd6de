//! The times of the frames.

use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Largest number of frames of a film: their numbers have at most six digits.
pub const MAX_FRAMES: u32 = 1_000_000;
/// Largest frame rate, frames per second.
const MAX_RATE: f64 = 1000.0;

/// Frames per second, a number such as 30 or a ratio such as 30000/1001.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameRate {
    frames: f64,
    seconds: f64,
}

/// The text is not a [`FrameRate`].
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "must be a number above 0 and at most {MAX_RATE}, such as 30, or a ratio such as 30000/1001"
)]
pub struct FrameRateError;

impl FromStr for FrameRate {
    type Err = FrameRateError;

    fn from_str(text: &str) -> Result<Self, FrameRateError> {
        let (frames, seconds) = text.split_once('/').unwrap_or((text, "1"));
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|n| n.is_finite());
        let (frames, seconds) = number(frames).zip(number(seconds)).ok_or(FrameRateError)?;
        let possible = frames > 0.0 && seconds > 0.0 && frames / seconds <= MAX_RATE;
        let rate = FrameRate { frames, seconds };
        possible.then_some(rate).ok_or(FrameRateError)
    }
}

impl fmt::Display for FrameRate {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.seconds {
            1.0 => write!(f, "{}", self.frames),
            seconds => write!(f, "{}/{seconds}", self.frames),
        }
    }
}

/// The frames of a film, numbered from 0, and their times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmClock {
    rate: FrameRate,
    frames: u32,
}

/// Why a film cannot have such a length.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ClockError {
    /// The length is not a positive number.
    #[error("{0} is not a positive number of seconds")]
    Seconds(f64),
    /// There would be too many frames.
    #[error("{0:.0} frames are too many: a film has at most {MAX_FRAMES}")]
    TooManyFrames(f64),
}

impl FilmClock {
    /// The frames of a film of `seconds`: those with times from 0 to before `seconds`.
    ///
    /// # Errors
    /// [`ClockError`] unless there is at least one and at most [`MAX_FRAMES`].
    pub fn new(rate: FrameRate, seconds: f64) -> Result<Self, ClockError> {
        if !(seconds > 0.0 && seconds.is_finite()) {
            return Err(ClockError::Seconds(seconds));
        }
        // The margin is for rounding: 0.1 s of 30 frames per second are three frames.
        let frames = (seconds * rate.frames / rate.seconds - 1e-6)
            .ceil()
            .max(1.0);
        if frames > f64::from(MAX_FRAMES) {
            return Err(ClockError::TooManyFrames(frames));
        }
        Ok(FilmClock {
            rate,
            frames: frames as u32,
        })
    }

    /// Number of frames.
    pub fn frames(&self) -> u32 {
        self.frames
    }

    /// Frames per second.
    pub fn rate(&self) -> FrameRate {
        self.rate
    }

    /// Time of `frame`, s.
    pub fn time(&self, frame: u32) -> f64 {
        f64::from(frame) * self.rate.seconds / self.rate.frames
    }

    /// Time from one frame to the next, s.
    pub fn period(&self) -> f64 {
        self.rate.seconds / self.rate.frames
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_rates_are_numbers_and_ratios() {
        for (text, period) in [
            ("30", 1.0 / 30.0),
            ("23.976", 1.0 / 23.976),
            ("30000/1001", 1001.0 / 30000.0),
        ] {
            let rate: FrameRate = text.parse().unwrap();
            assert_eq!(rate.to_string(), text);
            assert!((FilmClock::new(rate, 1.0).unwrap().period() - period).abs() < 1e-15);
        }
        for text in ["", "0", "-30", "NaN", "inf", "1001", "30/0", "30/1/1", "a"] {
            assert_eq!(text.parse::<FrameRate>(), Err(FrameRateError), "{text}");
        }
    }

    #[test]
    fn a_film_has_the_frames_before_its_end() {
        let frames = |seconds: f64| {
            FilmClock::new("30".parse().unwrap(), seconds).map(|clock| clock.frames())
        };
        assert_eq!(frames(8.0), Ok(240));
        assert_eq!(frames(0.1), Ok(3));
        assert_eq!(frames(0.11), Ok(4));
        assert_eq!(frames(1e-9), Ok(1));
        for seconds in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(
                matches!(frames(seconds), Err(ClockError::Seconds(_))),
                "{seconds}"
            );
        }
        assert_eq!(frames(1e6), Err(ClockError::TooManyFrames(3e7)));
        let clock = FilmClock::new("24".parse().unwrap(), 2.0).unwrap();
        assert_eq!((clock.time(0), clock.time(36)), (0.0, 1.5));
    }
}
