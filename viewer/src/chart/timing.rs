//! Time a ray, all methods interleaved: in every round each has its turn, so that a machine that slows
//! down slows all of them.

use crate::gpu::{FrameTime, Gpu, GpuError, Prepared, Timer};
use std::time::Duration;

/// A time a ray over several rounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// Median, ns.
    pub ns: f64,
    /// Relative spread: 1.48 × the median absolute deviation, over the median.
    pub spread: f64,
}

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
    fn of(frames: &[FrameTime], rays: usize) -> Self {
        let ns = |time: Duration| 1e9 * time.as_secs_f64() / rays as f64;
        let gpu: Option<Vec<f64>> = frames.iter().map(|frame| frame.gpu.map(ns)).collect();
        let wall: Vec<f64> = frames.iter().map(|frame| ns(frame.wall)).collect();
        FrameTimes {
            gpu: gpu.map(|times| Time::of(&times)),
            wall: Time::of(&wall),
        }
    }
}

impl Time {
    fn of(times: &[f64]) -> Self {
        let ns = median(times.to_vec());
        let deviation = median(times.iter().map(|t| (t - ns).abs()).collect());
        Time {
            ns,
            spread: 1.48 * deviation / ns,
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

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_round_changes_neither_time_nor_spread_much() {
        let time = Time::of(&[10.0, 10.1, 9.9, 10.0, 90.0]);
        assert_eq!(time.ns, 10.0);
        assert!(time.spread < 0.02);
    }

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
