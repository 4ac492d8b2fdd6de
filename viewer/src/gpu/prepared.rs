//! A scene made ready on a GPU, in bands of rows: a driver resets a GPU that is busy for seconds.

use super::renderer::Renderer;
use super::{Frame, Gpu, Output, shader_source};
use crate::scene::{Method, Scene};
use lensbake_tables::{Interpolation, Row, Texel};
use wgpu::util::DeviceExt;
use wgpu::*;

/// Bytes of a pixel as the shaders write it.
const PIXEL: u64 = size_of::<[f32; 4]>() as u64;
/// Pixels of a band at the most: 16 MiB of output.
const BAND: u32 = 1 << 20;
/// Ray steps of a band at the most, for direct integration: a fraction of a second on a small GPU.
const BAND_STEPS: f64 = 1e8;
/// Side of a workgroup in the shaders, pixels.
const WORKGROUP: u32 = 8;

/// A scene's pipeline, its row, and the bands it is drawn in.
#[derive(Debug)]
pub struct Prepared<'a> {
    renderer: &'a Renderer<'a>,
    pipeline: ComputePipeline,
    bands: Vec<Band>,
    written: Buffer,
    width: u32,
    output: Output,
}

/// Some rows of pixels: one dispatch.
#[derive(Debug)]
pub struct Band {
    bind_group: BindGroup,
    first_row: u32,
    rows: u32,
}

impl Band {
    /// How many rows of pixels.
    pub fn rows(&self) -> u32 {
        self.rows
    }

    /// The row of pixels after the last.
    pub fn end(&self) -> u32 {
        self.first_row + self.rows
    }
}

impl<'a> Prepared<'a> {
    pub(super) fn new(renderer: &'a Renderer<'a>, scene: &Scene, output: Output) -> Self {
        let camera = &scene.camera;
        let band_rows = band_rows(scene);
        let row = row_texture(renderer.gpu, &scene.row);
        let written = renderer.gpu.device.create_buffer(&BufferDescriptor {
            label: Some("pixels"),
            size: u64::from(band_rows) * u64::from(camera.width) * PIXEL,
            usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let band = |first_row| {
            let rows = band_rows.min(camera.height - first_row);
            let frame = Frame::new(scene, first_row, rows);
            Band {
                bind_group: frame_bind_group(renderer, &frame, &row, &written),
                first_row,
                rows,
            }
        };
        Prepared {
            renderer,
            pipeline: pipeline(renderer, scene, output),
            bands: (0..camera.height)
                .step_by(band_rows as usize)
                .map(band)
                .collect(),
            written,
            width: camera.width,
            output,
        }
    }

    /// The bands, from the top down.
    pub fn bands(&self) -> &[Band] {
        &self.bands
    }

    /// Where each band writes its pixels in turn, `[rows][width][4]` of f32.
    pub fn written(&self) -> &Buffer {
        &self.written
    }

    /// Encodes the drawing of one band; `timestamps` notes when it begins and ends.
    pub fn encode(
        &self,
        encoder: &mut CommandEncoder,
        band: &Band,
        timestamps: Option<ComputePassTimestampWrites>,
    ) {
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
            label: Some(self.output.entry_point()),
            timestamp_writes: timestamps,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &band.bind_group, &[]);
        if self.output == Output::Picture {
            pass.set_bind_group(1, &self.renderer.sky, &[]);
        }
        let workgroups = |pixels: u32| pixels.div_ceil(WORKGROUP);
        pass.dispatch_workgroups(workgroups(self.width), workgroups(band.rows), 1);
    }
}

/// Rows of pixels a dispatch may have.
fn band_rows(scene: &Scene) -> u32 {
    let most_pixels = match scene.method {
        Method::Direct { step } => {
            // A ray turns by about π; those that turn more are few.
            let steps_per_pixel = std::f64::consts::PI / step;
            BAND.min((BAND_STEPS / steps_per_pixel) as u32)
        }
        Method::Lut | Method::Flat => BAND,
    };
    (most_pixels / scene.camera.width).clamp(1, scene.camera.height)
}

fn pipeline(renderer: &Renderer, scene: &Scene, output: Output) -> ComputePipeline {
    let device = &renderer.gpu.device;
    let texels = scene.row.texel_count();
    let source = shader_source(scene.method, output, texels, scene.row.interpolation());
    let module = device.create_shader_module(ShaderModuleDescriptor {
        label: Some(output.entry_point()),
        source: ShaderSource::Wgsl(source.into()),
    });
    let groups = [Some(&renderer.frame_layout), Some(&renderer.sky_layout)];
    let used = if output == Output::Picture { 2 } else { 1 };
    let layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &groups[..used],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: Some(output.entry_point()),
        layout: Some(&layout),
        module: &module,
        entry_point: Some(output.entry_point()),
        compilation_options: Default::default(),
        cache: None,
    })
}

fn frame_bind_group(
    renderer: &Renderer,
    frame: &Frame,
    row: &TextureView,
    output: &Buffer,
) -> BindGroup {
    let uniform = renderer
        .gpu
        .device
        .create_buffer_init(&util::BufferInitDescriptor {
            label: Some("frame"),
            contents: bytemuck::bytes_of(frame),
            usage: BufferUsages::UNIFORM,
        });
    renderer.gpu.device.create_bind_group(&BindGroupDescriptor {
        label: Some("frame"),
        layout: &renderer.frame_layout,
        entries: &[
            resource(0, uniform.as_entire_binding()),
            resource(1, BindingResource::TextureView(row)),
            resource(2, output.as_entire_binding()),
        ],
    })
}

/// The row as a 1-D texture: values and slopes, or the values alone where no slope is read.
fn row_texture(gpu: &Gpu, row: &Row) -> TextureView {
    let texels: Vec<Texel> = row.gpu_texels();
    let values: Vec<f32> = texels.iter().map(|texel| texel[0]).collect();
    let (format, contents) = match row.interpolation() {
        Interpolation::Linear => (TextureFormat::R32Float, bytemuck::cast_slice(&values)),
        Interpolation::Hermite => (TextureFormat::Rg32Float, bytemuck::cast_slice(&texels)),
    };
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &TextureDescriptor {
            label: Some("row"),
            size: Extent3d {
                width: row.texel_count(),
                height: 1,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D1,
            format,
            usage: TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        util::TextureDataOrder::LayerMajor,
        contents,
    );
    texture.create_view(&Default::default())
}

pub(super) fn resource(binding: u32, resource: BindingResource<'_>) -> BindGroupEntry<'_> {
    BindGroupEntry { binding, resource }
}
