//! Time a ray, all methods interleaved: in every round each has its turn, so that a machine that slows
//! down slows all of them.

use crate::gpu::{FrameTime, Gpu, GpuError, Prepared, Timer};
use lensbake_report::Time;
use std::time::Duration;

/// The time a ray by both clocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameTimes {
    /// By the GPU's timestamps, if it has them.
    pub gpu: Option<Time>,
    /// By the wall clock.
    pub wall: Time,
}

impl FrameTimes {
    /// By the GPU's timestamps if it has them, else by the wall clock.
    pub fn best(&self) -> Time {
        self.gpu.unwrap_or(self.wall)
    }

    /// Of the frames drawn, `rays` rays each.
    pub fn of(frames: &[FrameTime], rays: usize) -> Self {
        let ns = |time: Duration| 1e9 * time.as_secs_f64() / rays as f64;
        let gpu: Option<Vec<f64>> = frames.iter().map(|frame| frame.gpu.map(ns)).collect();
        let wall: Vec<f64> = frames.iter().map(|frame| ns(frame.wall)).collect();
        FrameTimes {
            gpu: gpu.map(|times| Time::of(&times)),
            wall: Time::of(&wall),
        }
    }
}

/// Frames drawn before the first is timed: a first dispatch still compiles.
const WARM_UP: usize = 2;

/// Times prepared frames of `rays` rays each; `round_done` is called after each round.
///
/// # Errors
/// [`GpuError::Failed`] if the device does.
pub fn interleaved(
    gpu: &Gpu,
    frames: &[Prepared],
    rays: usize,
    rounds: u32,
    round_done: impl Fn(),
) -> Result<Vec<FrameTimes>, GpuError> {
    let timer = Timer::new(gpu);
    for frame in frames {
        for _ in 0..WARM_UP {
            timer.time(frame)?;
        }
    }
    let mut times = vec![Vec::new(); frames.len()];
    for _ in 0..rounds {
        for (frame, times) in frames.iter().zip(&mut times) {
            times.push(timer.time(frame)?);
        }
        round_done();
    }
    Ok(times.iter().map(|t| FrameTimes::of(t, rays)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_timestamps_the_wall_clock_counts() {
        let frame = |gpu| FrameTime {
            gpu,
            wall: Duration::from_nanos(300),
        };
        let stamped = FrameTimes::of(&[frame(Some(Duration::from_nanos(200)))], 100);
        assert_eq!((stamped.best().ns, stamped.wall.ns), (2.0, 3.0));
        assert_eq!(FrameTimes::of(&[frame(None)], 100).best().ns, 3.0);
    }
}
