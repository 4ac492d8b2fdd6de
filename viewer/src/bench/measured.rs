//! What the frames of one method come to.

use crate::chart::FrameTimes;
use crate::gpu::FrameTime;
use serde::Serialize;
use std::time::Duration;

/// Frames a second and times a ray.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measured {
    /// Frames drawn.
    pub frames: usize,
    /// Frames over the time they took together, by the wall clock.
    pub average_fps: f64,
    /// Of the slowest frame, by the wall clock.
    pub minimum_fps: f64,
    /// T_ray by the GPU's timestamps, median, ns; none where there are no timestamps.
    pub gpu_ns_a_ray: Option<f64>,
    /// T_ray by the wall clock, median, ns: the preparation and the way to the GPU included.
    pub wall_ns_a_ray: f64,
    /// Relative spread of the latter.
    pub wall_spread: f64,
}

impl Measured {
    /// Of frames of so many rays each.
    pub(super) fn of(frames: &[FrameTime], rays: usize) -> Self {
        let total: Duration = frames.iter().map(|frame| frame.wall).sum();
        let slowest = frames.iter().map(|frame| frame.wall).max();
        let FrameTimes { gpu, wall } = FrameTimes::of(frames, rays);
        Measured {
            frames: frames.len(),
            average_fps: frames.len() as f64 / total.as_secs_f64(),
            minimum_fps: 1.0 / slowest.unwrap_or_default().as_secs_f64(),
            gpu_ns_a_ray: gpu.map(|time| time.ns),
            wall_ns_a_ray: wall.ns,
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
            (measured.wall_ns_a_ray - 1000.0).abs() < 1e-9,
            "10 ms of 10,000 rays"
        );
    }
}
