//! Statistics of the frames of one contender.

use crate::gpu_time::{FrameTime, FrameTimes};
use serde::Serialize;
use std::time::Duration;

/// Frame rates and times per ray (T_ray).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measured {
    /// Number of frames drawn.
    pub frames: usize,
    /// Number of frames over their total time, by the wall clock.
    pub average_fps: f64,
    /// Frame rate of the slowest frame, by the wall clock.
    pub minimum_fps: f64,
    /// T_ray by the GPU's timestamps, median, ns; `None` without timestamps.
    pub gpu_ns_per_ray: Option<f64>,
    /// T_ray by the wall clock, median, ns, with the preparation on the CPU and the latency of the GPU.
    pub wall_ns_per_ray: f64,
    /// Relative spread of `wall_ns_per_ray`.
    pub wall_spread: f64,
}

impl Measured {
    /// Statistics of `frames`, of `rays` rays each.
    pub(super) fn of(frames: &[FrameTime], rays: usize) -> Self {
        let total: Duration = frames.iter().map(|frame| frame.wall).sum();
        let slowest = frames.iter().map(|frame| frame.wall).max();
        let FrameTimes { gpu, wall } = FrameTimes::of(frames, rays);
        Measured {
            frames: frames.len(),
            average_fps: frames.len() as f64 / total.as_secs_f64(),
            minimum_fps: 1.0 / slowest.unwrap_or_default().as_secs_f64(),
            gpu_ns_per_ray: gpu.map(|time| time.ns),
            wall_ns_per_ray: wall.ns,
            wall_spread: wall.spread,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_averaged_by_time() {
        let frame = |ms| FrameTime {
            gpu: None,
            wall: Duration::from_millis(ms),
        };
        let measured = Measured::of(&[frame(10), frame(10), frame(40)], 10_000);
        assert!((measured.average_fps - 50.0).abs() < 1e-9);
        assert!((measured.minimum_fps - 25.0).abs() < 1e-9);
        assert!(
            (measured.wall_ns_per_ray - 1000.0).abs() < 1e-9,
            "10 ms of 10,000 rays"
        );
    }
}
