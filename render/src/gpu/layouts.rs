//! The bind group layouts that pipelines and resources share.

use super::Gpu;
use super::bindings::*;
use super::source::Store;
use wgpu::*;

/// Format of a [`Store::Texture`], the same as in `shaders/output_texture.wgsl`.
pub(super) const TEXTURE_FORMAT: TextureFormat = TextureFormat::Rgba16Float;
/// Format of the texture in which a render pass draws a [`Store::Buffer`].
pub(super) const BAND_FORMAT: TextureFormat = TextureFormat::Rgba32Float;

/// The shared bind group layouts of a device.
#[derive(Debug)]
pub(super) struct Layouts {
    /// Group 1: the sky and its sampler.
    pub(super) sky: BindGroupLayout,
    /// The group after the others: the disc.
    pub(super) disc: BindGroupLayout,
    /// Group 0 of a fragment program.
    pub(super) fragment: BindGroupLayout,
    compute: Option<ComputeLayouts>,
}

/// The bind group layouts of compute programs, and of what they write.
#[derive(Debug)]
pub(super) struct ComputeLayouts {
    /// Group 0 of a program that classifies tiles.
    pub(super) classify: BindGroupLayout,
    /// Group 2: the star lists.
    pub(super) star_lists: BindGroupLayout,
    buffer: BindGroupLayout,
    texture: BindGroupLayout,
}

impl Layouts {
    /// The layouts of a device. Without compute shaders there are none for what only they need: storage buffers and
    /// storage textures.
    pub(super) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let drawing = if gpu.has_compute() {
            ShaderStages::COMPUTE | ShaderStages::FRAGMENT
        } else {
            ShaderStages::FRAGMENT
        };
        let sky = [
            texture_binding(TextureViewDimension::Cube, true),
            BindingType::Sampler(SamplerBindingType::Filtering),
        ];
        let fragment = [uniform_binding(false), uniform_binding(true), row_binding()];
        let stages = ShaderStages::FRAGMENT;
        Layouts {
            sky: bind_group_layout(device, "sky", drawing, &sky),
            disc: bind_group_layout(device, "disc", drawing, &[uniform_binding(false)]),
            fragment: bind_group_layout(device, "picture in a render pass", stages, &fragment),
            compute: gpu.has_compute().then(|| ComputeLayouts::new(device)),
        }
    }

    /// The layouts of compute programs.
    ///
    /// # Panics
    /// If the device has no compute shaders.
    pub(super) fn compute(&self) -> &ComputeLayouts {
        let compute = self.compute.as_ref();
        compute.expect("compute passes are drawn only where there are compute shaders")
    }
}

impl ComputeLayouts {
    fn new(device: &Device) -> Self {
        let layout =
            |label, bindings: &_| bind_group_layout(device, label, ShaderStages::COMPUTE, bindings);
        let (camera, region) = (uniform_binding(false), uniform_binding(true));
        let row = row_binding();
        let written = storage_buffer_binding(false);
        let draw = |label, output| {
            let tiles = storage_buffer_binding(true);
            layout(label, &[camera, region, row, output, tiles])
        };
        ComputeLayouts {
            classify: layout("classify_tiles", &[camera, region, row, written, written]),
            // Read by fragments as well.
            star_lists: bind_group_layout(
                device,
                "lists of stars",
                ShaderStages::COMPUTE | ShaderStages::FRAGMENT,
                &[uint_texture_binding(), uint_texture_binding()],
            ),
            buffer: draw("picture in a buffer", written),
            texture: draw(
                "picture in a texture",
                storage_texture_binding(TEXTURE_FORMAT),
            ),
        }
    }

    /// Group 0 of a program that draws.
    pub(super) fn draw(&self, store: Store) -> &BindGroupLayout {
        match store {
            Store::Buffer => &self.buffer,
            Store::Texture => &self.texture,
        }
    }
}

fn row_binding() -> BindingType {
    texture_binding(TextureViewDimension::D2, false)
}
