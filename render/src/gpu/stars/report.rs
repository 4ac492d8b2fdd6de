//! Reports whether the star lists held all light, without waiting for the GPU: the node count, which is the number
//! of nodes that a frame requested, is read back a few frames later.

use super::nodes::Group;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use wgpu::*;

/// Largest number of frames whose counts are being copied back at the same time.
const IN_FLIGHT: usize = 4;

/// Whether the light of every star is in a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StarLight {
    /// The light of all stars is.
    Whole,
    /// Some images are missing, because there were more than the GPU has room for.
    PartLost,
}

/// The node counts of the last frames.
#[derive(Debug)]
pub(super) struct Reports {
    group: Group,
    slots: Vec<Arc<Slot>>,
    frames: AtomicU64,
}

/// The node count of one frame, and the state of its copy to the CPU.
#[derive(Debug)]
struct Slot {
    /// Buffer of the node count, u32.
    requested: Buffer,
    state: Mutex<State>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Free,
    /// The copy is encoded, and will be submitted before [`Reports::arrived`] is called.
    Encoded(FrameLists),
    UnderWay(FrameLists),
    Arrived(FrameLists),
}

/// What the CPU knows about the lists of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct FrameLists {
    /// Number of frames before it.
    number: u64,
    /// Whether there were more images than were sent to the GPU.
    full: bool,
}

impl Reports {
    pub(super) fn new(device: &Device, group: Group) -> Self {
        let slot = |_| {
            let requested = device.create_buffer(&BufferDescriptor {
                label: Some("nodes requested"),
                size: size_of::<u32>() as u64,
                usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            Arc::new(Slot {
                requested,
                state: Mutex::new(State::Free),
            })
        };
        Reports {
            group,
            slots: (0..IN_FLIGHT).map(slot).collect(),
            frames: AtomicU64::new(0),
        }
    }

    /// Encodes the copy of the node count, the first number of `heads`, to the CPU. `full`: there were more images
    /// than were sent to the GPU.
    pub(super) fn encode(&self, encoder: &mut CommandEncoder, heads: &Buffer, full: bool) {
        let free = |slot: &&Arc<Slot>| *slot.state() == State::Free;
        // If no slot is free, a frame whose read-back has not started gives way to the newer one.
        let unread = |slot: &&Arc<Slot>| matches!(*slot.state(), State::Encoded(_));
        let slot = self.slots.iter().find(free);
        let Some(slot) = slot.or_else(|| self.slots.iter().find(unread)) else {
            return;
        };
        encoder.copy_buffer_to_buffer(heads, 0, &slot.requested, 0, slot.requested.size());
        let number = self.frames.fetch_add(1, Ordering::Relaxed);
        *slot.state() = State::Encoded(FrameLists { number, full });
    }

    /// The report of the newest frame whose node count has arrived since the last call. To be called after the
    /// encoded commands are submitted.
    pub(super) fn arrived(&self) -> Option<StarLight> {
        for slot in &self.slots {
            send_back(slot);
        }
        let arrived = self.slots.iter().filter_map(|slot| slot.take(self.group));
        arrived
            .max_by_key(|(number, _)| *number)
            .map(|(_, light)| light)
    }

    /// Whether a node count is under way.
    pub(super) fn under_way(&self) -> bool {
        self.slots.iter().any(|slot| *slot.state() != State::Free)
    }
}

/// Starts the read-back of a frame's node count, which arrives as soon as the frame is drawn.
fn send_back(slot: &Arc<Slot>) {
    let State::Encoded(frame) = *slot.state() else {
        return;
    };
    *slot.state() = State::UnderWay(frame);
    let arriving = slot.clone();
    slot.requested
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

    fn take(&self, group: Group) -> Option<(u64, StarLight)> {
        let State::Arrived(frame) = *self.state() else {
            return None;
        };
        let requested = self.requested.slice(..).get_mapped_range().ok();
        let requested = requested.map(|view| bytemuck::pod_read_unaligned::<u32>(&view));
        self.requested.unmap();
        *self.state() = State::Free;
        let light = StarLight::of(requested?, group, frame.full);
        Some((frame.number, light))
    }
}

impl StarLight {
    /// The report of a frame that requested `requested` nodes for a list for each `group` of pixels. `full`: there were more images
    /// than were sent to the GPU.
    pub(super) fn of(requested: u32, group: Group, full: bool) -> Self {
        if full || !group.fits(requested) {
            StarLight::PartLost
        } else {
            StarLight::Whole
        }
    }
}
