//! Stars on a GPU.
//!
//! A first dispatch finds the images of the stars and inserts their light into linked lists, one for each small
//! group of pixels; a second one inserts the pieces of arcs. Two more dispatches shorten the lists that have become too
//! long. The heads of the lists are copied to a texture, and the picture sums up the lists. In this way the light is summed in f32 on every device with compute shaders, which neither integer
//! atomics nor blending into 16-bit floats would achieve.

mod data;
mod lists;
mod nodes;
mod programs;
mod report;

pub(super) use lists::StarLists;
pub(super) use nodes::Group;
pub(super) use programs::StarPrograms;
pub use report::StarLight;

use super::Gpu;
use crate::stars::StarField;
use crate::stars::cells::Cells;
use data::GpuStar;
use std::sync::Arc;
use wgpu::util::DeviceExt;
use wgpu::*;

/// Stars on the device, sorted into cells of the sky; a clone refers to the same upload.
#[derive(Debug, Clone)]
pub struct StarsOnDevice(Arc<Stars>);

#[derive(Debug)]
struct Stars {
    cells: Cells,
    /// The stars, on a device that can list their images.
    buffer: Option<Buffer>,
}

impl StarsOnDevice {
    pub(super) fn new(gpu: &Gpu, field: &StarField) -> Self {
        let cells = Cells::new(field);
        let buffer = gpu.has_compute().then(|| {
            let stars: Vec<GpuStar> = cells.stars().iter().map(GpuStar::from).collect();
            gpu.device.create_buffer_init(&util::BufferInitDescriptor {
                label: Some("stars"),
                contents: bytemuck::cast_slice(&stars),
                usage: BufferUsages::STORAGE,
            })
        });
        StarsOnDevice(Arc::new(Stars { cells, buffer }))
    }

    /// What the program that lists their images binds.
    fn binding(&self) -> BindingResource<'_> {
        let buffer = self.0.buffer.as_ref();
        let buffer = buffer.expect("star lists are made only where there are compute shaders");
        buffer.as_entire_binding()
    }
}

impl PartialEq for StarsOnDevice {
    /// Whether both are the same upload.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
