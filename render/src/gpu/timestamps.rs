//! Timestamps of a frame on the GPU and their copy to the CPU: when the frame begins, when its picture is drawn,
//! and when it is presented in the window.

use std::time::Duration;
use wgpu::*;

const TIMESTAMPS: u32 = 3;

/// The timestamps that a pass writes when it begins and when it ends, whether it computes or renders.
#[derive(Debug, Clone, Copy)]
pub struct PassTimestamps<'a> {
    queries: &'a QuerySet,
    begins: Option<u32>,
    ends: Option<u32>,
}

impl<'a> PassTimestamps<'a> {
    /// The same for a compute pass.
    pub fn of_compute_pass(self) -> ComputePassTimestampWrites<'a> {
        ComputePassTimestampWrites {
            query_set: self.queries,
            beginning_of_pass_write_index: self.begins,
            end_of_pass_write_index: self.ends,
        }
    }

    /// The same for a render pass.
    pub fn of_render_pass(self) -> RenderPassTimestampWrites<'a> {
        RenderPassTimestampWrites {
            query_set: self.queries,
            beginning_of_pass_write_index: self.begins,
            end_of_pass_write_index: self.ends,
        }
    }

    /// The timestamp of the beginning for a pass that comes first, and the one of the end for the pass after it.
    /// Either is `None` if it is not written, because a pass must write at least one.
    pub(super) fn split(self) -> (Option<Self>, Option<Self>) {
        let begins = self.begins.map(|_| PassTimestamps { ends: None, ..self });
        let ends = self.ends.map(|_| PassTimestamps {
            begins: None,
            ..self
        });
        (begins, ends)
    }
}

/// The three timestamps of a frame.
#[derive(Debug)]
pub struct Timestamps {
    queries: QuerySet,
    resolved: Buffer,
    read_back: Buffer,
}

impl Timestamps {
    /// Timestamps on a device that supports them.
    pub fn new(device: &Device) -> Self {
        let buffer = |usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some("timestamps"),
                size: u64::from(TIMESTAMPS) * u64::from(QUERY_SIZE),
                usage,
                mapped_at_creation: false,
            })
        };
        Timestamps {
            queries: device.create_query_set(&QuerySetDescriptor {
                label: Some("timestamps"),
                ty: QueryType::Timestamp,
                count: TIMESTAMPS,
            }),
            resolved: buffer(BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
            read_back: buffer(BufferUsages::COPY_DST | BufferUsages::MAP_READ),
        }
    }

    /// Timestamp writes of a pass that begins the picture, ends it, or both.
    pub fn around_pass(&self, begins: bool, ends: bool) -> PassTimestamps<'_> {
        PassTimestamps {
            queries: &self.queries,
            begins: begins.then_some(0),
            ends: ends.then_some(1),
        }
    }

    /// Timestamp writes of the render pass that presents the picture.
    pub fn after_window(&self) -> RenderPassTimestampWrites<'_> {
        RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: None,
            end_of_pass_write_index: Some(2),
        }
    }

    /// Encodes the copy of the first `stamps` timestamps to the read-back buffer, after the last pass.
    pub fn resolve(&self, encoder: &mut CommandEncoder, stamps: u32) {
        encoder.resolve_query_set(&self.queries, 0..stamps, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read_back, 0, self.read_back.size());
    }

    /// The read-back buffer, `[3]` of u64.
    pub fn read_back(&self) -> &Buffer {
        &self.read_back
    }
}

/// The time from the first timestamp to timestamp `last`, at `period_ns` nanoseconds per tick.
pub fn elapsed(ticks: &[u64], last: usize, period_ns: f32) -> Duration {
    let ticks = ticks[last].saturating_sub(ticks[0]);
    Duration::from_secs_f64(1e-9 * ticks as f64 * f64::from(period_ns))
}
