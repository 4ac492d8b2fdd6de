//! The GPU's own times of a frame, and the way they come back: when it begins, when its picture is done,
//! and when it is in the window.

use std::time::Duration;
use wgpu::*;

const STAMPS: u32 = 3;

/// Three timestamps.
#[derive(Debug)]
pub(super) struct Stamps {
    queries: QuerySet,
    resolved: Buffer,
    read_back: Buffer,
}

impl Stamps {
    /// On a device that has timestamps.
    pub fn new(device: &Device) -> Self {
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

    /// What a pass of the picture notes that begins it, ends it, or both.
    pub fn around_pass(&self, begins: bool, ends: bool) -> ComputePassTimestampWrites<'_> {
        ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: begins.then_some(0),
            end_of_pass_write_index: ends.then_some(1),
        }
    }

    /// What the pass notes that brings the picture to the window.
    pub fn after_window(&self) -> RenderPassTimestampWrites<'_> {
        RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: None,
            end_of_pass_write_index: Some(2),
        }
    }

    /// Encodes the way back of the first `stamps`, after the last pass.
    pub fn resolve(&self, encoder: &mut CommandEncoder, stamps: u32) {
        encoder.resolve_query_set(&self.queries, 0..stamps, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read_back, 0, self.read_back.size());
    }

    /// Where they come back to, `[3]` of u64.
    pub fn read_back(&self) -> &Buffer {
        &self.read_back
    }
}

/// The time from the first stamp to stamp `last`, `period_ns` nanoseconds a tick.
pub(super) fn elapsed(ticks: &[u64], last: usize, period_ns: f32) -> Duration {
    let ticks = ticks[last].saturating_sub(ticks[0]);
    Duration::from_secs_f64(1e-9 * ticks as f64 * f64::from(period_ns))
}
