//! Draws scenes on a GPU, in bands of rows: a driver resets a GPU that is busy for seconds.

use super::{Frame, Gpu, GpuError, Output, shader_source};
use crate::picture::Picture;
use crate::scene::{Method, Scene};
use crate::sky::Sky;
use glam::{DVec3, Vec3};
use lensbake_core::Fate;
use lensbake_tables::{Interpolation, Row, Texel};
use wgpu::util::DeviceExt;
use wgpu::*;

/// Where the light of each pixel comes from: unit directions in the hole frame, row-major
/// [height][width].
pub type Trace = Vec<Fate<DVec3>>;

/// Bytes of a pixel as the shaders write it.
const PIXEL: u64 = size_of::<[f32; 4]>() as u64;
/// Pixels of a band at the most: 16 MiB of output.
const BAND: u32 = 1 << 20;
/// Ray steps of a band at the most, for direct integration: a fraction of a second on a small GPU.
const BAND_STEPS: f64 = 1e8;
/// Side of a workgroup in the shaders, pixels.
const WORKGROUP: u32 = 8;

/// A renderer on one device, with one sky.
#[derive(Debug)]
pub struct Renderer<'a> {
    gpu: &'a Gpu,
    frame_layout: BindGroupLayout,
    sky_layout: BindGroupLayout,
    sky: BindGroup,
}

impl<'a> Renderer<'a> {
    /// A renderer that has `sky` on the device.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the sky does not fit.
    pub fn new(gpu: &'a Gpu, sky: &Sky) -> Result<Self, GpuError> {
        let device = &gpu.device;
        let sky_layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor {
            label: Some("sky"),
            entries: &[
                entry(0, texture_binding(TextureViewDimension::Cube, true)),
                entry(1, BindingType::Sampler(SamplerBindingType::Filtering)),
            ],
        });
        let frame_layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[
                entry(0, buffer_binding(BufferBindingType::Uniform)),
                entry(1, texture_binding(TextureViewDimension::D1, false)),
                entry(
                    2,
                    buffer_binding(BufferBindingType::Storage { read_only: false }),
                ),
            ],
        });
        let sky = sky_bind_group(gpu, &sky_layout, sky);
        gpu.wait()?;
        Ok(Renderer {
            gpu,
            frame_layout,
            sky_layout,
            sky,
        })
    }

    /// Draws the picture of a scene. `band_done` is called with the rows of pixels done so far.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device does.
    pub fn picture(&self, scene: &Scene, band_done: impl Fn(u32)) -> Result<Picture, GpuError> {
        let pixels = self.run(scene, Output::Picture, band_done)?;
        let light = pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect();
        Ok(Picture::new(scene.camera.width, scene.camera.height, light))
    }

    /// Finds where each pixel's light comes from. A direct integration that does not finish counts as
    /// captured.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device does.
    pub fn trace(&self, scene: &Scene, band_done: impl Fn(u32)) -> Result<Trace, GpuError> {
        const ESCAPES: f32 = 1.0;
        let pixels = self.run(scene, Output::Trace, band_done)?;
        let decode = |[x, y, z, fate]: [f32; 4]| {
            if fate == ESCAPES {
                Fate::Escapes(Vec3::new(x, y, z).as_dvec3())
            } else {
                Fate::Captured
            }
        };
        Ok(pixels.into_iter().map(decode).collect())
    }

    fn run(
        &self,
        scene: &Scene,
        output: Output,
        band_done: impl Fn(u32),
    ) -> Result<Vec<[f32; 4]>, GpuError> {
        let Gpu { device, queue, .. } = self.gpu;
        let camera = &scene.camera;
        let band_rows = band_rows(scene);
        let row = row_texture(self.gpu, &scene.row);
        let pipeline = self.pipeline(scene, output);
        let bytes = u64::from(band_rows) * u64::from(camera.width) * PIXEL;
        let buffer = |usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some("pixels"),
                size: bytes,
                usage,
                mapped_at_creation: false,
            })
        };
        let written = buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let read_back = buffer(BufferUsages::COPY_DST | BufferUsages::MAP_READ);
        let mut pixels = Vec::with_capacity(camera.pixels());
        for first_row in (0..camera.height).step_by(band_rows as usize) {
            let rows = band_rows.min(camera.height - first_row);
            let frame = Frame::new(scene, first_row, rows);
            let bind_group = self.frame_bind_group(&frame, &row, &written);
            let mut encoder = device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(&pipeline);
                pass.set_bind_group(0, &bind_group, &[]);
                if output == Output::Picture {
                    pass.set_bind_group(1, &self.sky, &[]);
                }
                pass.dispatch_workgroups(
                    camera.width.div_ceil(WORKGROUP),
                    rows.div_ceil(WORKGROUP),
                    1,
                );
            }
            encoder.copy_buffer_to_buffer(&written, 0, &read_back, 0, bytes);
            queue.submit([encoder.finish()]);
            let band: Vec<[f32; 4]> = self.gpu.read(&read_back)?;
            pixels.extend(&band[..rows as usize * camera.width as usize]);
            band_done(first_row + rows);
        }
        Ok(pixels)
    }

    fn pipeline(&self, scene: &Scene, output: Output) -> ComputePipeline {
        let device = &self.gpu.device;
        let texels = scene.row.texel_count();
        let source = shader_source(scene.method, output, texels, scene.row.interpolation());
        let module = device.create_shader_module(ShaderModuleDescriptor {
            label: Some(output.entry_point()),
            source: ShaderSource::Wgsl(source.into()),
        });
        let groups = [Some(&self.frame_layout), Some(&self.sky_layout)];
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

    fn frame_bind_group(&self, frame: &Frame, row: &TextureView, output: &Buffer) -> BindGroup {
        let uniform = self
            .gpu
            .device
            .create_buffer_init(&util::BufferInitDescriptor {
                label: Some("frame"),
                contents: bytemuck::bytes_of(frame),
                usage: BufferUsages::UNIFORM,
            });
        self.gpu.device.create_bind_group(&BindGroupDescriptor {
            label: Some("frame"),
            layout: &self.frame_layout,
            entries: &[
                resource(0, uniform.as_entire_binding()),
                resource(1, BindingResource::TextureView(row)),
                resource(2, output.as_entire_binding()),
            ],
        })
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

/// The sky as a cube texture with seamless bilinear filtering.
fn sky_bind_group(gpu: &Gpu, layout: &BindGroupLayout, sky: &Sky) -> BindGroup {
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &TextureDescriptor {
            label: Some("sky"),
            size: Extent3d {
                width: sky.face_texels(),
                height: sky.face_texels(),
                depth_or_array_layers: 6,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: TextureFormat::Rgba16Float,
            usage: TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        util::TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(sky.texels()),
    );
    let view = texture.create_view(&TextureViewDescriptor {
        dimension: Some(TextureViewDimension::Cube),
        ..Default::default()
    });
    let sampler = gpu.device.create_sampler(&SamplerDescriptor {
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        ..Default::default()
    });
    gpu.device.create_bind_group(&BindGroupDescriptor {
        label: Some("sky"),
        layout,
        entries: &[
            resource(0, BindingResource::TextureView(&view)),
            resource(1, BindingResource::Sampler(&sampler)),
        ],
    })
}

fn entry(binding: u32, ty: BindingType) -> BindGroupLayoutEntry {
    BindGroupLayoutEntry {
        binding,
        visibility: ShaderStages::COMPUTE,
        ty,
        count: None,
    }
}

fn buffer_binding(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn texture_binding(view_dimension: TextureViewDimension, filterable: bool) -> BindingType {
    BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable },
        view_dimension,
        multisampled: false,
    }
}

fn resource(binding: u32, resource: BindingResource<'_>) -> BindGroupEntry<'_> {
    BindGroupEntry { binding, resource }
}
