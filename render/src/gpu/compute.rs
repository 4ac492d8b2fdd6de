//! Compute shaders and their pipelines.

use super::bindings::{bind_group_layout, pipeline_layout};
use super::timestamps::PassTimestamps;
use wgpu::*;

/// A compute pipeline with all its bindings in group 0, and the layout of that group.
#[derive(Debug)]
pub(super) struct ComputeShader {
    pub(super) layout: BindGroupLayout,
    pub(super) pipeline: ComputePipeline,
}

impl ComputeShader {
    /// Compiles the shader with this entry point. Too slow to do in a frame.
    pub(super) fn new(
        device: &Device,
        entry_point: &str,
        bindings: &[BindingType],
        source: String,
    ) -> Self {
        let layout = bind_group_layout(device, entry_point, ShaderStages::COMPUTE, bindings);
        let module = module(device, entry_point, source);
        let pipeline = pipeline(device, entry_point, &[&layout], &module);
        ComputeShader { layout, pipeline }
    }
}

/// Begins a compute pass; `timestamps` records when it begins and ends.
pub(super) fn begin_compute<'a>(
    encoder: &'a mut CommandEncoder,
    label: &str,
    timestamps: Option<PassTimestamps>,
) -> ComputePass<'a> {
    encoder.begin_compute_pass(&ComputePassDescriptor {
        label: Some(label),
        timestamp_writes: timestamps.map(PassTimestamps::of_compute_pass),
    })
}

/// A shader module of this WGSL source.
pub(super) fn module(device: &Device, label: &str, source: String) -> ShaderModule {
    device.create_shader_module(ShaderModuleDescriptor {
        label: Some(label),
        source: ShaderSource::Wgsl(source.into()),
    })
}

/// The compute pipeline of an entry point, with bind groups of these layouts.
pub(super) fn pipeline(
    device: &Device,
    entry_point: &str,
    groups: &[&BindGroupLayout],
    module: &ShaderModule,
) -> ComputePipeline {
    specialised_pipeline(device, entry_point, groups, module, &[])
}

/// As [`pipeline`], with these values of overridable constants of the module.
pub(super) fn specialised_pipeline(
    device: &Device,
    entry_point: &str,
    groups: &[&BindGroupLayout],
    module: &ShaderModule,
    constants: &[(&str, f64)],
) -> ComputePipeline {
    let label = Some(entry_point);
    let layout = pipeline_layout(device, entry_point, groups);
    device.create_compute_pipeline(&ComputePipelineDescriptor {
        label,
        layout: Some(&layout),
        module,
        entry_point: label,
        compilation_options: PipelineCompilationOptions {
            constants,
            ..Default::default()
        },
        cache: None,
    })
}
