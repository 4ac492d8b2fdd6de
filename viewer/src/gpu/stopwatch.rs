//! How long frames take on the GPU, found out without waiting for them: a frame's timestamps are read
//! when they have come back, a few frames later.

use super::stamps::{Stamps, elapsed};
use super::{Gpu, Passes};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;
use wgpu::*;

/// Frames whose timestamps may be on their way at the same time.
const IN_FLIGHT: usize = 4;

/// Notes when frames begin and end on a GPU.
#[derive(Debug)]
pub struct Stopwatch {
    period_ns: f32,
    slots: Vec<Arc<Slot>>,
}

/// One frame's stamps, and where they are.
#[derive(Debug)]
struct Slot {
    stamps: Stamps,
    state: AtomicU8,
}

const FREE: u8 = 0;
const UNDER_WAY: u8 = 1;
const ARRIVED: u8 = 2;

/// The GPU's time of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lap {
    /// For the picture.
    pub picture: Duration,
    /// For the picture and for bringing it to the window.
    pub frame: Duration,
}

/// A frame that is being timed.
#[derive(Debug)]
pub struct Timed(Arc<Slot>);

impl Stopwatch {
    /// A stopwatch for `gpu`; without timestamps on it, one that never tells a time.
    pub fn new(gpu: &Gpu) -> Self {
        let slots = if gpu.has_timestamps() { IN_FLIGHT } else { 0 };
        let slot = |_| {
            Arc::new(Slot {
                stamps: Stamps::new(&gpu.device),
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

    /// The times of the frames whose stamps have arrived.
    pub fn arrived(&self) -> impl Iterator<Item = Lap> {
        self.slots
            .iter()
            .filter_map(|slot| slot.take(self.period_ns))
    }
}

impl Timed {
    /// What the pass notes that brings the picture to the window.
    pub fn after_window(&self) -> RenderPassTimestampWrites<'_> {
        self.0.stamps.after_window()
    }

    /// Encodes the way back, after that pass.
    pub fn resolve(&self, encoder: &mut CommandEncoder) {
        self.0.stamps.resolve(encoder, 3);
    }

    /// Waits for no one: the stamps arrive when they do. To be called after the last submission.
    pub fn send_back(self) {
        let Timed(slot) = self;
        slot.state.store(UNDER_WAY, Ordering::Release);
        let whole = slot.stamps.read_back().slice(..);
        let arriving = slot.clone();
        whole.map_async(MapMode::Read, move |mapped| {
            let next = if mapped.is_ok() { ARRIVED } else { FREE };
            arriving.state.store(next, Ordering::Release);
        });
    }
}

impl Slot {
    fn is(&self, state: u8) -> bool {
        self.state.load(Ordering::Acquire) == state
    }

    fn take(&self, period_ns: f32) -> Option<Lap> {
        if !self.is(ARRIVED) {
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
