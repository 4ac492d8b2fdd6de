//! Render pipelines that draw one triangle over their target: `shaders/full_screen.wgsl`.

use super::bindings::pipeline_layout;
use wgpu::*;

/// What such a pipeline is made of.
pub(super) struct FullScreen<'a> {
    pub(super) label: &'a str,
    pub(super) groups: &'a [&'a BindGroupLayout],
    pub(super) module: &'a ShaderModule,
    /// The entry point of its fragments.
    pub(super) entry_point: &'a str,
    /// Values of the constants that the shader lets a pipeline override.
    pub(super) constants: &'a [(&'a str, f64)],
    /// Format of the target.
    pub(super) format: TextureFormat,
}

/// Compiles the pipeline. Too slow to do in a frame.
pub(super) fn full_screen_pipeline(device: &Device, of: FullScreen) -> RenderPipeline {
    let layout = pipeline_layout(device, of.label, of.groups);
    device.create_render_pipeline(&RenderPipelineDescriptor {
        label: Some(of.label),
        layout: Some(&layout),
        vertex: VertexState {
            module: of.module,
            entry_point: Some("corner"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        fragment: Some(FragmentState {
            module: of.module,
            entry_point: Some(of.entry_point),
            compilation_options: PipelineCompilationOptions {
                constants: of.constants,
                ..Default::default()
            },
            targets: &[Some(of.format.into())],
        }),
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        multiview_mask: None,
        cache: None,
    })
}
