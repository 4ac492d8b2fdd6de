//! Time that a GPU takes to draw frames: the dispatches only, without preparation and read-back.

use crate::figure::Time;
use lensbake_render::gpu::{Gpu, GpuError, Passes, Timestamps, elapsed};
use std::time::{Duration, Instant};

/// The time of one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FrameTime {
    /// By the GPU's timestamps. `None` without them, and on a software adapter: llvmpipe (Mesa 22.3) may write
    /// both timestamps of a single dispatch when it ends.
    pub gpu: Option<Duration>,
    /// By the wall clock, from submission to completion; on a GPU this includes the latency of both.
    pub wall: Duration,
}

impl FrameTime {
    /// Time per ray of a frame of `rays` rays, ns: by the GPU's timestamps, or by the wall clock without them.
    pub fn ns_per_ray(&self, rays: usize) -> f64 {
        1e9 * self.gpu.unwrap_or(self.wall).as_secs_f64() / rays as f64
    }
}

/// Time per ray over several frames, by both clocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameTimes {
    /// By the GPU's timestamps; `None` without them.
    pub gpu: Option<Time>,
    /// By the wall clock.
    pub wall: Time,
}

impl FrameTimes {
    /// By the GPU's timestamps, or by the wall clock without them.
    pub fn best(&self) -> Time {
        self.gpu.unwrap_or(self.wall)
    }

    /// The times of `frames`, `rays` rays each.
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

/// Times frames on one device.
#[derive(Debug)]
pub struct Timer<'a> {
    gpu: &'a Gpu,
    timestamps: Option<Timestamps>,
}

impl<'a> Timer<'a> {
    /// A timer for `gpu`.
    pub fn new(gpu: &'a Gpu) -> Self {
        let has_clock = gpu.has_timestamps() && !gpu.is_software();
        Timer {
            gpu,
            timestamps: has_clock.then(|| Timestamps::new(&gpu.device)),
        }
    }

    /// Draws a frame and returns its time, the sum over its passes. Each pass is submitted on its own.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device fails.
    pub async fn time(&self, frame: &impl Passes) -> Result<FrameTime, GpuError> {
        let mut sum = FrameTime {
            gpu: self.timestamps.as_ref().map(|_| Duration::ZERO),
            wall: Duration::ZERO,
        };
        for pass in 0..frame.count() {
            let time = self.time_pass(frame, pass).await?;
            sum.wall += time.wall;
            sum.gpu = sum.gpu.zip(time.gpu).map(|(sum, time)| sum + time);
        }
        Ok(sum)
    }

    async fn time_pass(&self, frame: &impl Passes, pass: usize) -> Result<FrameTime, GpuError> {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let around = self.timestamps.as_ref().map(|t| t.around_pass(true, true));
        frame.encode(&mut encoder, pass, around);
        if let Some(timestamps) = &self.timestamps {
            timestamps.resolve(&mut encoder, 2);
        }
        let commands = encoder.finish();
        let started = Instant::now();
        self.gpu.queue.submit([commands]);
        self.gpu.wait().await?;
        let wall = started.elapsed();
        let gpu = match &self.timestamps {
            Some(timestamps) => {
                let ticks: Vec<u64> = self.gpu.read(timestamps.read_back()).await?;
                Some(elapsed(&ticks, 1, self.gpu.queue.get_timestamp_period()))
            }
            None => None,
        };
        Ok(FrameTime { gpu, wall })
    }
}

/// Frames drawn before timing starts: the first dispatch may still compile shaders.
const WARM_UP: usize = 2;

/// Times prepared frames of `rays` rays each. Every round draws each frame once, so that a machine that slows down
/// slows all of them. `round_done` is called after each round.
///
/// # Errors
/// [`GpuError::Failed`] if the device fails.
pub async fn interleaved(
    gpu: &Gpu,
    frames: &[impl Passes],
    rays: usize,
    rounds: u32,
    round_done: impl Fn(),
) -> Result<Vec<FrameTimes>, GpuError> {
    let timer = Timer::new(gpu);
    for frame in frames {
        for _ in 0..WARM_UP {
            timer.time(frame).await?;
        }
    }
    let mut times = vec![Vec::new(); frames.len()];
    for _ in 0..rounds {
        for (frame, times) in frames.iter().zip(&mut times) {
            times.push(timer.time(frame).await?);
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
