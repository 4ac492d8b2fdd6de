//! A dispatch with all its bindings in one group.

use super::bindings::bind_group_layout;
use wgpu::*;

/// A compute pipeline and the layout of its group 0.
#[derive(Debug)]
pub(super) struct Step {
    pub(super) layout: BindGroupLayout,
    pub(super) pipeline: ComputePipeline,
}

impl Step {
    /// The step of this entry point. Compiles: nothing to do in a frame.
    pub(super) fn new(
        device: &Device,
        entry_point: &str,
        bindings: &[BindingType],
        source: &str,
    ) -> Self {
        let layout = bind_group_layout(device, entry_point, ShaderStages::COMPUTE, bindings);
        let module = module(device, entry_point, source.to_owned());
        let pipeline = pipeline(device, entry_point, &[&layout], &module);
        Step { layout, pipeline }
    }
}

/// A shader of this WGSL.
pub(super) fn module(device: &Device, label: &str, source: String) -> ShaderModule {
    device.create_shader_module(ShaderModuleDescriptor {
        label: Some(label),
        source: ShaderSource::Wgsl(source.into()),
    })
}

/// The pipeline of an entry point with bind groups of these layouts.
pub(super) fn pipeline(
    device: &Device,
    entry_point: &str,
    groups: &[&BindGroupLayout],
    module: &ShaderModule,
) -> ComputePipeline {
    let label = Some(entry_point);
    let groups: Vec<_> = groups.iter().copied().map(Some).collect();
    let layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &groups,
        immediate_size: 0,
    });
    device.create_compute_pipeline(&ComputePipelineDescriptor {
        label,
        layout: Some(&layout),
        module,
        entry_point: label,
        compilation_options: Default::default(),
        cache: None,
    })
}
