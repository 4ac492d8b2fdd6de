//! Draws scenes on a GPU.

use super::bindings::{
    bind_group, bind_group_layout, storage_buffer_binding, storage_texture_binding,
    texture_binding, uniform_binding,
};
use super::blocks::Sorter;
use super::canvas::TEXTURE_FORMAT;
use super::stars::Stars;
use super::step;
use super::{
    Gpu, GpuError, Output, Passes, Prepared, Store, Target, Tile, entry_points, shader_source,
};
use crate::picture::Picture;
use crate::scene::{Method, Sampling, Scene};
use crate::sky::{Cube, Sky};
use crate::stars::StarField;
use glam::{DVec3, Vec3};
use lensbake_core::Fate;
use lensbake_tables::Row;
use std::sync::Arc;
use wgpu::*;

/// Where the light of each pixel comes from: unit directions in the hole frame, row-major
/// `[height][width]`.
pub type Trace = Vec<Fate<DVec3>>;

/// A sky on the device; a clone is the same sky.
#[derive(Debug, Clone)]
pub struct SkyOnDevice {
    pub(super) bind_group: BindGroup,
}

/// Bytes of a texel of the sky.
const SKY_TEXEL: u32 = size_of::<[half::f16; 4]>() as u32;

/// What draws the tiles of a canvas.
#[derive(Debug)]
pub struct Program {
    pub(super) name: &'static str,
    /// Whether stars stand before what it draws.
    pub(super) sees_stars: bool,
    /// One for every pixel, or one for each list of blocks.
    pub(super) pipelines: Vec<ComputePipeline>,
    /// What makes those lists.
    pub(super) sorter: Option<Sorter>,
}

/// A renderer on one device, with one sky; a clone has the same sky on the same device.
#[derive(Debug, Clone)]
pub struct Renderer {
    pub(super) gpu: Gpu,
    pub(super) sky: SkyOnDevice,
    sky_layout: BindGroupLayout,
    buffer_layout: BindGroupLayout,
    texture_layout: BindGroupLayout,
    /// Of what sorts blocks of pixels.
    pub(super) sort_layout: BindGroupLayout,
    pub(super) stars: Option<Arc<Stars>>,
}

impl Renderer {
    /// A renderer that has `sky` on the device.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the sky does not fit.
    pub fn new(gpu: &Gpu, sky: &Sky) -> Result<Self, GpuError> {
        let device = &gpu.device;
        let layout =
            |label, bindings: &_| bind_group_layout(device, label, ShaderStages::COMPUTE, bindings);
        let sky_layout = layout(
            "sky",
            &[
                texture_binding(TextureViewDimension::Cube, true),
                BindingType::Sampler(SamplerBindingType::Filtering),
            ],
        );
        let frame_layout = |label, output| {
            let row = texture_binding(TextureViewDimension::D2, false);
            let blocks = storage_buffer_binding(true);
            layout(label, &[uniform_binding(true), row, output, blocks])
        };
        let row = texture_binding(TextureViewDimension::D2, false);
        let written = storage_buffer_binding(false);
        let renderer = Renderer {
            sort_layout: layout(
                "sort_blocks",
                &[uniform_binding(true), row, written, written],
            ),
            sky: put_on_device(gpu, &sky_layout, sky),
            sky_layout,
            buffer_layout: frame_layout("frame to a buffer", storage_buffer_binding(false)),
            texture_layout: frame_layout(
                "frame to a texture",
                storage_texture_binding(TEXTURE_FORMAT),
            ),
            stars: None,
            gpu: gpu.clone(),
        };
        gpu.wait()?;
        Ok(renderer)
    }

    /// The same renderer with the stars of `field` before its sky. They are seen by pipelines and canvases
    /// made from now on.
    pub fn with_stars(mut self, field: &StarField) -> Self {
        self.set_stars(Some(field));
        self
    }

    /// Has the stars of `field` before its sky, or none. Programs and canvases made before do not know.
    pub(super) fn set_stars(&mut self, field: Option<&StarField>) {
        self.stars = field.map(|field| Arc::new(Stars::new(&self.gpu, field)));
    }

    /// Puts another sky on the device.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if it does not fit; the device can be used on.
    pub fn upload(&self, sky: &Sky) -> Result<SkyOnDevice, GpuError> {
        let sky = self
            .gpu
            .attempt(|| put_on_device(&self.gpu, &self.sky_layout, sky))?;
        self.gpu.wait()?;
        Ok(sky)
    }

    /// The sky that it draws before.
    pub fn sky(&self) -> SkyOnDevice {
        self.sky.clone()
    }

    /// Draws before this sky from now on.
    pub fn set_sky(&mut self, sky: &SkyOnDevice) {
        self.sky = sky.clone();
    }

    /// The device it draws on.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The bind group layout of a frame and what it is written to.
    pub(super) fn frame_layout(&self, store: Store) -> &BindGroupLayout {
        match store {
            Store::Buffer => &self.buffer_layout,
            Store::Texture => &self.texture_layout,
        }
    }

    /// The program that draws `output` by `method` with rows of the shape of `row`; a picture by
    /// `sampling`. Compiles: nothing to do in a frame.
    pub fn program(
        &self,
        method: Method,
        sampling: Sampling,
        output: Output,
        store: Store,
        row: &Row,
    ) -> Program {
        let device = &self.gpu.device;
        let (texels, interpolation) = (row.texel_count(), row.interpolation());
        let stars = self.stars.as_ref().filter(|_| output == Output::Picture);
        let source = shader_source(
            method,
            sampling,
            output,
            store,
            texels,
            interpolation,
            stars.is_some(),
        );
        let module = step::module(device, output.name(), source);
        let groups = [self.frame_layout(store), &self.sky_layout];
        let lists = stars.map(|stars| &stars.list_layout);
        let groups: Vec<_> = groups.into_iter().chain(lists).collect();
        let pipeline = |entry_point: &&str| step::pipeline(device, entry_point, &groups, &module);
        let filtered = output == Output::Picture && sampling == Sampling::Filtered;
        let sorter = filtered.then(|| {
            let groups = [&self.sort_layout, &self.sky_layout];
            Sorter::new(device, &groups, method, texels, interpolation)
        });
        Program {
            name: output.name(),
            sees_stars: stars.is_some(),
            pipelines: entry_points(sampling, output)
                .iter()
                .map(pipeline)
                .collect(),
            sorter,
        }
    }

    /// Draws the picture of a scene. `band_done` is called with the rows of pixels done so far.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device does, [`GpuError::TooManyStars`] if its lists are too short.
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
    pub fn prepare(&self, scene: &Scene, output: Output) -> Prepared {
        Prepared::new(self, scene, output)
    }

    fn run(
        &self,
        scene: &Scene,
        output: Output,
        band_done: impl Fn(u32),
    ) -> Result<Vec<[f32; 4]>, GpuError> {
        let mut pixels = Vec::with_capacity(scene.camera.pixels());
        self.stream(scene, output, |band, written| {
            pixels.extend(written);
            band_done(band.first[1] + band.count[1]);
        })?;
        Ok(pixels)
    }

    /// Draws a scene and calls `take` with each of its bands, from the top down, and the band's pixels:
    /// for pictures too large to be kept.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device does, [`GpuError::TooManyStars`] before the first band is taken if there
    /// is no room for all of them.
    pub fn stream(
        &self,
        scene: &Scene,
        output: Output,
        mut take: impl FnMut(Tile, &[[f32; 4]]),
    ) -> Result<(), GpuError> {
        let Gpu { device, queue, .. } = &self.gpu;
        let prepared = self.prepare(scene, output);
        let Target::Buffer(written) = prepared.canvas().target() else {
            unreachable!("prepared to be read back");
        };
        let read_back = device.create_buffer(&BufferDescriptor {
            label: Some("pixels read back"),
            size: written.size(),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        for (i, &band) in prepared.bands().iter().enumerate() {
            let mut encoder = device.create_command_encoder(&Default::default());
            prepared.encode(&mut encoder, i, None);
            encoder.copy_buffer_to_buffer(written, 0, &read_back, 0, read_back.size());
            queue.submit([encoder.finish()]);
            let written: Vec<[f32; 4]> = self.gpu.read(&read_back)?;
            if i == 0 {
                // All bands read the lists that were made with the first.
                prepared.canvas().check_stars(&self.gpu)?;
            }
            let [width, rows] = band.count;
            take(band, &written[..rows as usize * width as usize]);
        }
        Ok(())
    }
}

/// The sky as a cube texture with its mip chain and seamless trilinear filtering.
fn put_on_device(gpu: &Gpu, layout: &BindGroupLayout, sky: &Sky) -> SkyOnDevice {
    let size = |cube: &Cube| Extent3d {
        width: cube.face_texels(),
        height: cube.face_texels(),
        depth_or_array_layers: 6,
    };
    let texture = gpu.device.create_texture(&TextureDescriptor {
        label: Some("sky"),
        size: size(&sky.levels()[0]),
        mip_level_count: sky.levels().len() as u32,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format: TextureFormat::Rgba16Float,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (mip_level, cube) in (0..).zip(sky.levels()) {
        let place = TexelCopyTextureInfo {
            mip_level,
            ..texture.as_image_copy()
        };
        let bytes = bytemuck::cast_slice(cube.texels());
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(SKY_TEXEL * cube.face_texels()),
            rows_per_image: Some(cube.face_texels()),
        };
        gpu.queue.write_texture(place, bytes, layout, size(cube));
    }
    let view = texture.create_view(&TextureViewDescriptor {
        dimension: Some(TextureViewDimension::Cube),
        ..Default::default()
    });
    let sampler = gpu.device.create_sampler(&SamplerDescriptor {
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        mipmap_filter: MipmapFilterMode::Linear,
        ..Default::default()
    });
    let resources = [
        BindingResource::TextureView(&view),
        BindingResource::Sampler(&sampler),
    ];
    SkyOnDevice {
        bind_group: bind_group(&gpu.device, "sky", layout, resources),
    }
}
