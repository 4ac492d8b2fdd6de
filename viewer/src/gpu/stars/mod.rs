//! Stars on a GPU. A first dispatch finds the images of every star and puts their light into lists, one for
//! each small group of pixels; two more shorten the lists that have become too long; the picture adds up the lists. So the light is summed in f32, which no
//! integer atomic and no blending into 16-bit floats would give, on any device that can compute.

mod data;
mod lists;
mod nodes;
mod report;
mod shader;

pub(super) use lists::StarLists;
pub use report::StarLight;
pub(super) use shader::keep;

use super::Gpu;
use super::bindings::{
    bind_group_layout, storage_buffer_binding, storage_texture_binding, uint_texture_binding,
    uniform_binding,
};
use super::step::Step;
use crate::stars::StarField;
use crate::stars::cells::Cells;
use data::GpuStar;
use wgpu::util::DeviceExt;
use wgpu::*;

/// Stars on a device, and the pipelines that draw them.
#[derive(Debug)]
pub(super) struct Stars {
    cells: Cells,
    buffer: Buffer,
    bent: Step,
    flat: Step,
    folding: Step,
    linking: Step,
    pub(super) list_layout: BindGroupLayout,
}

impl Stars {
    pub(super) fn new(gpu: &Gpu, field: &StarField) -> Self {
        let device = &gpu.device;
        let cells = Cells::new(field);
        let stars: Vec<GpuStar> = cells.stars().iter().map(GpuStar::from).collect();
        let written = storage_texture_binding(nodes::FORMAT);
        let overflows = |name, nodes, source: String| {
            let bindings = [uniform_binding(false), storage_buffer_binding(false), nodes];
            Step::new(device, name, &bindings, &source)
        };
        let lists = |lens| {
            let (read, write) = (storage_buffer_binding(true), storage_buffer_binding(false));
            let uniform = uniform_binding(false);
            let bindings = [uniform, uniform, read, read, read, write, written];
            Step::new(device, "sort_stars", &bindings, &shader::lists(lens))
        };
        Stars {
            buffer: device.create_buffer_init(&util::BufferInitDescriptor {
                label: Some("stars"),
                contents: bytemuck::cast_slice(&stars),
                usage: BufferUsages::STORAGE,
            }),
            bent: lists(shader::BENT),
            flat: lists(shader::FLAT),
            folding: overflows("fold_stars", uint_texture_binding(), shader::folding()),
            linking: overflows("link_stars", written, shader::linking()),
            list_layout: bind_group_layout(
                device,
                "lists of stars",
                ShaderStages::COMPUTE,
                &[storage_buffer_binding(true), uint_texture_binding()],
            ),
            cells,
        }
    }
}
