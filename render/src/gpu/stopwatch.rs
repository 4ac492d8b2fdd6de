//! Measures how long frames take on the GPU without waiting for them: the timestamps of a frame are read a few
//! frames later.

use super::timestamps::{Timestamps, elapsed};
use super::{Gpu, Passes};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;
use wgpu::*;

/// Largest number of frames whose timestamps are being copied back at the same time.
const IN_FLIGHT: usize = 4;

/// Times frames on a GPU.
#[derive(Debug)]
pub struct Stopwatch {
    period_ns: f32,
    slots: Vec<Arc<Slot>>,
}

/// The timestamps of one frame, and the state of their copy to the CPU.
#[derive(Debug)]
struct Slot {
    stamps: Timestamps,
    state: AtomicU8,
}

const FREE: u8 = 0;
const PENDING: u8 = 1;
const READY: u8 = 2;

/// GPU time of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lap {
    /// Time to draw the picture.
    pub picture: Duration,
    /// Time to draw the picture and present it in the window.
    pub frame: Duration,
}

/// A frame that is being timed.
#[derive(Debug)]
pub struct Timed(Arc<Slot>);

impl Stopwatch {
    /// A stopwatch for `gpu`. If the device has no timestamps, it never returns a time.
    pub fn new(gpu: &Gpu) -> Self {
        let slots = if gpu.has_timestamps() { IN_FLIGHT } else { 0 };
        let slot = |_| {
            Arc::new(Slot {
                stamps: Timestamps::new(&gpu.device),
                state: AtomicU8::new(FREE),
            })
        };
        Stopwatch {
            period_ns: gpu.queue.get_timestamp_period(),
            slots: (0..slots).map(slot).collect(),
        }
    }

    /// Submits a picture pass by pass, timed if a slot is free.
    pub fn submit(&self, gpu: &Gpu, picture: &impl Passes) -> Option<Timed> {
        let slot = self.slots.iter().find(|slot| slot.is(FREE));
        let slot = slot.filter(|_| picture.count() > 0);
        for pass in 0..picture.count() {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let (begins, ends) = (pass == 0, pass + 1 == picture.count());
            let stamps = slot.filter(|_| begins || ends);
            let stamps = stamps.map(|slot| slot.stamps.around_pass(begins, ends));
            picture.encode(&mut encoder, pass, stamps);
            gpu.queue.submit([encoder.finish()]);
        }
        slot.cloned().map(Timed)
    }

    /// The times of the frames whose timestamps have arrived since the last call.
    pub fn arrived(&self) -> impl Iterator<Item = Lap> {
        self.slots
            .iter()
            .filter_map(|slot| slot.take(self.period_ns))
    }
}

impl Timed {
    /// Timestamp writes of the render pass that presents the picture.
    pub fn after_window(&self) -> RenderPassTimestampWrites<'_> {
        self.0.stamps.after_window()
    }

    /// Encodes the copy of the timestamps to their read-back buffer, after that pass.
    pub fn resolve(&self, encoder: &mut CommandEncoder) {
        self.0.stamps.resolve(encoder, 3);
    }

    /// Starts reading the timestamps, without waiting for them. To be called after the last submission of the
    /// frame.
    pub fn send_back(self) {
        let Timed(slot) = self;
        slot.state.store(PENDING, Ordering::Release);
        let whole = slot.stamps.read_back().slice(..);
        let arriving = slot.clone();
        whole.map_async(MapMode::Read, move |mapped| {
            let next = if mapped.is_ok() { READY } else { FREE };
            arriving.state.store(next, Ordering::Release);
        });
    }
}

impl Slot {
    fn is(&self, state: u8) -> bool {
        self.state.load(Ordering::Acquire) == state
    }

    fn take(&self, period_ns: f32) -> Option<Lap> {
        if !self.is(READY) {
            return None;
        }
        let buffer = self.stamps.read_back();
        let lap = buffer.slice(..).get_mapped_range().ok().map(|view| {
            let ticks: &[u64] = bytemuck::cast_slice(&view);
            Lap {
                picture: elapsed(ticks, 1, period_ns),
                frame: elapsed(ticks, 2, period_ns),
            }
        });
        buffer.unmap();
        self.state.store(FREE, Ordering::Release);
        lap
    }
}
