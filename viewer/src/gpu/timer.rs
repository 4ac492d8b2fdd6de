//! How long a GPU takes to draw what has been prepared: the dispatches alone, nothing made and nothing
//! read back.

use super::stamps::{Stamps, elapsed};
use super::{Gpu, GpuError};
use std::time::{Duration, Instant};
use wgpu::*;

/// A frame that only needs to be submitted: pass by pass, since a driver resets a GPU that is busy for
/// seconds.
pub trait Passes {
    /// How many passes.
    fn count(&self) -> usize;

    /// Encodes one of them; `timestamps` notes when it begins and ends.
    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        pass: usize,
        timestamps: Option<ComputePassTimestampWrites>,
    );
}

/// The time of one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FrameTime {
    /// By the GPU's own timestamps, if it has them and is no software: llvmpipe (Mesa 22.3) may note both of a
    /// lone dispatch when it is over.
    pub gpu: Option<Duration>,
    /// By the wall clock, from submission to completion; on a GPU this holds the way there and back.
    pub wall: Duration,
}

impl FrameTime {
    /// The time of each of so many rays by the GPU's timestamps where there are any, else by the wall clock,
    /// ns.
    pub fn ns_a_ray(&self, rays: usize) -> f64 {
        1e9 * self.gpu.unwrap_or(self.wall).as_secs_f64() / rays as f64
    }
}

/// Times frames on one device.
#[derive(Debug)]
pub struct Timer<'a> {
    gpu: &'a Gpu,
    stamps: Option<Stamps>,
}

impl<'a> Timer<'a> {
    /// A timer for `gpu`.
    pub fn new(gpu: &'a Gpu) -> Self {
        Timer {
            gpu,
            stamps: (gpu.has_timestamps() && !gpu.is_software()).then(|| Stamps::new(&gpu.device)),
        }
    }

    /// Draws a frame and times it; its passes, submitted one by one, are added up.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device does.
    pub fn time(&self, frame: &impl Passes) -> Result<FrameTime, GpuError> {
        let mut sum = FrameTime {
            gpu: self.stamps.as_ref().map(|_| Duration::ZERO),
            wall: Duration::ZERO,
        };
        for pass in 0..frame.count() {
            let time = self.time_pass(frame, pass)?;
            sum.wall += time.wall;
            sum.gpu = sum.gpu.zip(time.gpu).map(|(sum, time)| sum + time);
        }
        Ok(sum)
    }

    fn time_pass(&self, frame: &impl Passes, pass: usize) -> Result<FrameTime, GpuError> {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        frame.encode(
            &mut encoder,
            pass,
            self.stamps.as_ref().map(|s| s.around_pass(true, true)),
        );
        if let Some(stamps) = &self.stamps {
            stamps.resolve(&mut encoder, 2);
        }
        let commands = encoder.finish();
        let started = Instant::now();
        self.gpu.queue.submit([commands]);
        self.gpu.wait()?;
        let wall = started.elapsed();
        let ticks = self.stamps.as_ref();
        let ticks = ticks.map(|s| self.gpu.read::<u64>(s.read_back()));
        let period_ns = self.gpu.queue.get_timestamp_period();
        Ok(FrameTime {
            gpu: ticks
                .transpose()?
                .map(|ticks| elapsed(&ticks, 1, period_ns)),
            wall,
        })
    }
}
