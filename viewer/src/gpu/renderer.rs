//! Draws scenes on a GPU.

use super::prepared::{Prepared, resource};
use super::{Gpu, GpuError, Output};
use crate::picture::Picture;
use crate::scene::Scene;
use crate::sky::Sky;
use glam::{DVec3, Vec3};
use lensbake_core::Fate;
use wgpu::util::DeviceExt;
use wgpu::*;

/// Where the light of each pixel comes from: unit directions in the hole frame, row-major
/// `[height][width]`.
pub type Trace = Vec<Fate<DVec3>>;

/// A renderer on one device, with one sky.
#[derive(Debug)]
pub struct Renderer<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) frame_layout: BindGroupLayout,
    pub(super) sky_layout: BindGroupLayout,
    pub(super) sky: BindGroup,
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

    /// Makes everything that drawing `scene` needs, so that what remains are the dispatches.
    pub fn prepare(&self, scene: &Scene, output: Output) -> Prepared<'_> {
        Prepared::new(self, scene, output)
    }

    fn run(
        &self,
        scene: &Scene,
        output: Output,
        band_done: impl Fn(u32),
    ) -> Result<Vec<[f32; 4]>, GpuError> {
        let Gpu { device, queue, .. } = self.gpu;
        let prepared = self.prepare(scene, output);
        let read_back = device.create_buffer(&BufferDescriptor {
            label: Some("pixels read back"),
            size: prepared.written().size(),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut pixels = Vec::with_capacity(scene.camera.pixels());
        for band in prepared.bands() {
            let mut encoder = device.create_command_encoder(&Default::default());
            prepared.encode(&mut encoder, band, None);
            encoder.copy_buffer_to_buffer(prepared.written(), 0, &read_back, 0, read_back.size());
            queue.submit([encoder.finish()]);
            let written: Vec<[f32; 4]> = self.gpu.read(&read_back)?;
            pixels.extend(&written[..band.rows() as usize * scene.camera.width as usize]);
            band_done(band.end());
        }
        Ok(pixels)
    }
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
