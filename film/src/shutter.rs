//! The shutter: the moments whose light a frame is the mean of.

use thiserror::Error;

/// How long the shutter is open, and at how many moments light is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shutter {
    open: f64,
    moments: u32,
}

/// Why a shutter is not valid.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ShutterError {
    /// The time that it is open is out of range.
    #[error("{0} is not from 0 to 1, the part of a frame's time in which the shutter is open")]
    Open(f64),
}

impl Shutter {
    /// A shutter that is open for this part of the time from frame to frame, 0 to 1; light is taken at `moments` moments,
    /// at least one. A shutter of 0 takes it at one.
    ///
    /// # Errors
    /// [`ShutterError`] if `open` is out of range.
    pub fn new(open: f64, moments: u32) -> Result<Self, ShutterError> {
        if !(0.0..=1.0).contains(&open) {
            return Err(ShutterError::Open(open));
        }
        let moments = if open == 0.0 { 1 } else { moments.max(1) };
        Ok(Shutter { open, moments })
    }

    /// Number of moments.
    pub fn moments(self) -> u32 {
        self.moments
    }

    /// The moments of a frame at `time` (s), `period` (s) after the frame before: in the middles of equal parts of the time
    /// in which the shutter is open, which is centred on `time`.
    pub fn times(self, time: f64, period: f64) -> impl Iterator<Item = f64> {
        let part = 1.0 / f64::from(self.moments);
        (0..self.moments)
            .map(move |moment| time + ((f64::from(moment) + 0.5) * part - 0.5) * self.open * period)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moments_are_centred_on_the_frame() {
        let times = |open, moments| -> Vec<f64> {
            Shutter::new(open, moments)
                .unwrap()
                .times(2.0, 0.1)
                .collect()
        };
        assert_eq!(times(0.0, 8), [2.0]);
        assert_eq!(times(0.5, 1), [2.0]);
        let four = times(0.8, 4);
        for (time, known) in four.iter().zip([1.97, 1.99, 2.01, 2.03]) {
            assert!((time - known).abs() < 1e-12, "{four:?}");
        }
        for open in [-0.1, 1.1, f64::NAN] {
            assert!(Shutter::new(open, 8).is_err());
        }
    }
}
