//! Whether the lists of stars had room for all light, found out without waiting for the GPU: the number of places
//! that a frame asked for is read when it has come back, a few frames later.

use super::nodes;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use wgpu::*;

/// Frames whose numbers may be on their way at the same time.
const IN_FLIGHT: usize = 4;

/// Whether the light of every star is in a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StarLight {
    /// All of it is.
    Whole,
    /// There were more images than there is room for: some are missing.
    PartLost,
}

/// What the frames have asked for.
#[derive(Debug)]
pub(super) struct Reports {
    slots: Vec<Arc<Slot>>,
    frames: AtomicU64,
}

/// What one frame has asked for, and where it is.
#[derive(Debug)]
struct Slot {
    /// The number of places, u32.
    asked: Buffer,
    state: Mutex<State>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Free,
    /// Its copy is encoded, and submitted by the time that somebody asks for it.
    Encoded(FrameLists),
    UnderWay(FrameLists),
    Arrived(FrameLists),
}

/// What the CPU knows of a frame's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct FrameLists {
    /// Frames before it.
    number: u64,
    /// Whether there were more images than the GPU was told of.
    full: bool,
}

impl Reports {
    pub(super) fn new(device: &Device) -> Self {
        let slot = |_| {
            let asked = device.create_buffer(&BufferDescriptor {
                label: Some("places asked for"),
                size: size_of::<u32>() as u64,
                usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            Arc::new(Slot {
                asked,
                state: Mutex::new(State::Free),
            })
        };
        Reports {
            slots: (0..IN_FLIGHT).map(slot).collect(),
            frames: AtomicU64::new(0),
        }
    }

    /// Encodes the way back of the first number of `heads`. `full`: more images than the GPU was told of.
    pub(super) fn encode(&self, encoder: &mut CommandEncoder, heads: &Buffer, full: bool) {
        let free = |slot: &&Arc<Slot>| *slot.state() == State::Free;
        // A buffer that has not been read back yet is reused for the newer frame.
        let unasked = |slot: &&Arc<Slot>| matches!(*slot.state(), State::Encoded(_));
        let slot = self.slots.iter().find(free);
        let Some(slot) = slot.or_else(|| self.slots.iter().find(unasked)) else {
            return;
        };
        encoder.copy_buffer_to_buffer(heads, 0, &slot.asked, 0, slot.asked.size());
        let number = self.frames.fetch_add(1, Ordering::Relaxed);
        *slot.state() = State::Encoded(FrameLists { number, full });
    }

    /// What the newest frame tells of those that have come back since the last call. To be called after the
    /// submission of what was encoded.
    pub(super) fn arrived(&self) -> Option<StarLight> {
        for slot in &self.slots {
            send_back(slot);
        }
        let arrived = self.slots.iter().filter_map(|slot| slot.take());
        arrived
            .max_by_key(|(number, _)| *number)
            .map(|(_, light)| light)
    }

    /// Whether a frame has not come back yet.
    pub(super) fn under_way(&self) -> bool {
        self.slots.iter().any(|slot| *slot.state() != State::Free)
    }
}

/// Has the number of a frame brought to the CPU as soon as the frame is drawn.
fn send_back(slot: &Arc<Slot>) {
    let State::Encoded(frame) = *slot.state() else {
        return;
    };
    *slot.state() = State::UnderWay(frame);
    let arriving = slot.clone();
    slot.asked
        .slice(..)
        .map_async(MapMode::Read, move |mapped| {
            *arriving.state() = match mapped {
                Ok(()) => State::Arrived(frame),
                Err(_) => State::Free,
            };
        });
}

impl Slot {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self) -> Option<(u64, StarLight)> {
        let State::Arrived(frame) = *self.state() else {
            return None;
        };
        let asked = self.asked.slice(..).get_mapped_range().ok();
        let asked = asked.map(|view| bytemuck::pod_read_unaligned::<u32>(&view));
        self.asked.unmap();
        *self.state() = State::Free;
        let light = StarLight::of(asked?, frame.full);
        Some((frame.number, light))
    }
}

impl StarLight {
    /// When so many places were asked for; `full`: there were more images than the GPU was told of.
    pub(super) fn of(asked: u32, full: bool) -> Self {
        if full || !nodes::suffice(asked) {
            StarLight::PartLost
        } else {
            StarLight::Whole
        }
    }
}
