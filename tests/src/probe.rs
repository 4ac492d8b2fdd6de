//! Probes of WGSL functions: evaluates them on a GPU for many inputs.

use lensbake_render::gpu::{Gpu, row_texture_format, texture};
use lensbake_tables::lookup::{GpuRow, ROW_LINE, ShadowEdge};
use pollster::block_on;
use wgpu::util::DeviceExt;
use wgpu::*;

/// Bindings of group 0 that hold a probe's inputs (questions) and outputs (answers).
#[derive(Debug, Clone, Copy)]
pub struct Bindings {
    /// `var<storage, read>`, an array of questions.
    pub questions: u32,
    /// `var<storage, read_write>`, an array of one answer per question.
    pub answers: u32,
}

/// Runs the entry point `probe` of `source` with one invocation per question, 64 invocations per workgroup. The
/// texture of a row is bound to the binding given with it.
///
/// # Panics
/// If the device fails.
pub fn probe<Q: bytemuck::Pod, A: bytemuck::Pod>(
    gpu: &Gpu,
    source: String,
    bindings: Bindings,
    questions: &[Q],
    row: Option<(u32, TextureView)>,
) -> Vec<A> {
    let entry = row.as_ref().map(|(binding, view)| BindGroupEntry {
        binding: *binding,
        resource: BindingResource::TextureView(view),
    });
    probe_with(gpu, source, bindings, questions, entry.as_slice())
}

/// As [`probe`], with any other resources bound to group 0.
///
/// # Panics
/// If the device fails.
pub fn probe_with<Q: bytemuck::Pod, A: bytemuck::Pod>(
    gpu: &Gpu,
    source: String,
    bindings: Bindings,
    questions: &[Q],
    resources: &[BindGroupEntry],
) -> Vec<A> {
    let device = &gpu.device;
    let module = device.create_shader_module(ShaderModuleDescriptor {
        label: None,
        source: ShaderSource::Wgsl(source.into()),
    });
    let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("probe"),
        compilation_options: Default::default(),
        cache: None,
    });
    let asked = device.create_buffer_init(&util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(questions),
        usage: BufferUsages::STORAGE,
    });
    let written = device.create_buffer(&BufferDescriptor {
        label: None,
        size: (questions.len() * size_of::<A>()) as u64,
        usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let entry = |binding, resource| BindGroupEntry { binding, resource };
    let mut entries = vec![
        entry(bindings.questions, asked.as_entire_binding()),
        entry(bindings.answers, written.as_entire_binding()),
    ];
    entries.extend_from_slice(resources);
    let bind_group = device.create_bind_group(&BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.dispatch_workgroups((questions.len() as u32).div_ceil(64), 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    block_on(gpu.copy_back(&written, written.size())).unwrap()
}

/// The texture of `row`, in its format.
pub fn row_texture(gpu: &Gpu, row: &GpuRow) -> TextureView {
    let (shape, bytes) = (row.shape(), row.texture_bytes());
    uploaded(gpu, shape.texture_size(), row_texture_format(shape), &bytes)
}

/// A texture of `texels`, values and slopes, wrapped into lines.
pub fn texel_texture(gpu: &Gpu, texels: &[[f32; 2]]) -> TextureView {
    let count = texels.len() as u32;
    let [width, height] = [count.min(ROW_LINE), count.div_ceil(ROW_LINE)];
    let mut lines = texels.to_vec();
    lines.resize((width * height) as usize, [0.0; 2]);
    let bytes = bytemuck::cast_slice(&lines);
    uploaded(gpu, [width, height], TextureFormat::Rg32Float, bytes)
}

/// A texture of `size` that holds `bytes`, line by line.
pub fn uploaded(gpu: &Gpu, size: [u32; 2], format: TextureFormat, bytes: &[u8]) -> TextureView {
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let texture = texture(&gpu.device, "table", size, format, usage);
    let layout = TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(bytes.len() as u32 / texture.height()),
        rows_per_image: None,
    };
    let to = texture.as_image_copy();
    gpu.queue.write_texture(to, bytes, layout, texture.size());
    texture.create_view(&Default::default())
}

/// WGSL of the constant `EDGE`: the shadow's edge that a row is looked up with.
pub fn shadow_edge(edge: ShadowEdge) -> String {
    let ShadowEdge {
        tan_half,
        log_weight,
        away_slope,
        scale,
    } = edge;
    format!("const EDGE = ShadowEdge({tan_half:e}, {log_weight:e}, {away_slope:e}, {scale:e});\n")
}
