//! How long a GPU takes to draw what has been prepared: the dispatches alone, nothing made and nothing
//! read back.

use super::{Gpu, GpuError, Prepared};
use std::time::{Duration, Instant};
use wgpu::*;

/// The time of one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FrameTime {
    /// By the GPU's own timestamps, if it has them.
    pub gpu: Option<Duration>,
    /// By the wall clock, from submission to completion; on a GPU this holds the way there and back.
    pub wall: Duration,
}

/// Times frames on one device.
#[derive(Debug)]
pub struct Timer<'a> {
    gpu: &'a Gpu,
    stamps: Option<Stamps>,
}

/// The beginning and the end of a pass, and the way they come back.
#[derive(Debug)]
struct Stamps {
    queries: QuerySet,
    resolved: Buffer,
    read_back: Buffer,
}

const STAMPS: u32 = 2;

impl<'a> Timer<'a> {
    /// A timer for `gpu`.
    pub fn new(gpu: &'a Gpu) -> Self {
        Timer {
            gpu,
            stamps: gpu.has_timestamps().then(|| Stamps::new(&gpu.device)),
        }
    }

    /// Draws a prepared frame and times it; its bands, submitted one by one, are added up.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device does.
    pub fn time(&self, frame: &Prepared) -> Result<FrameTime, GpuError> {
        let mut sum = FrameTime {
            gpu: self.stamps.as_ref().map(|_| Duration::ZERO),
            wall: Duration::ZERO,
        };
        for band in 0..frame.bands().len() {
            let time = self.time_band(frame, band)?;
            sum.wall += time.wall;
            sum.gpu = sum.gpu.zip(time.gpu).map(|(sum, time)| sum + time);
        }
        Ok(sum)
    }

    fn time_band(&self, frame: &Prepared, band: usize) -> Result<FrameTime, GpuError> {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        frame.encode(
            &mut encoder,
            band,
            self.stamps.as_ref().map(Stamps::around_pass),
        );
        if let Some(stamps) = &self.stamps {
            stamps.resolve(&mut encoder);
        }
        let commands = encoder.finish();
        let started = Instant::now();
        self.gpu.queue.submit([commands]);
        self.gpu.wait()?;
        let wall = started.elapsed();
        let stamps = self.stamps.as_ref().map(|s| s.elapsed(self.gpu));
        Ok(FrameTime {
            gpu: stamps.transpose()?,
            wall,
        })
    }
}

impl Stamps {
    fn new(device: &Device) -> Self {
        let buffer = |usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some("timestamps"),
                size: u64::from(STAMPS) * u64::from(QUERY_SIZE),
                usage,
                mapped_at_creation: false,
            })
        };
        Stamps {
            queries: device.create_query_set(&QuerySetDescriptor {
                label: Some("timestamps"),
                ty: QueryType::Timestamp,
                count: STAMPS,
            }),
            resolved: buffer(BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
            read_back: buffer(BufferUsages::COPY_DST | BufferUsages::MAP_READ),
        }
    }

    fn around_pass(&self) -> ComputePassTimestampWrites<'_> {
        ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    fn resolve(&self, encoder: &mut CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..STAMPS, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read_back, 0, self.read_back.size());
    }

    fn elapsed(&self, gpu: &Gpu) -> Result<Duration, GpuError> {
        let ticks: Vec<u64> = gpu.read(&self.read_back)?;
        let elapsed = ticks[1].saturating_sub(ticks[0]);
        let ns = elapsed as f64 * f64::from(gpu.queue.get_timestamp_period());
        Ok(Duration::from_secs_f64(1e-9 * ns))
    }
}
