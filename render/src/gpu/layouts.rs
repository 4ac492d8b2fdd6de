//! The bind group layouts that pipelines and resources share.

use super::bindings::*;
use super::source::Store;
use wgpu::*;

/// Format of a [`Store::Texture`], the same as in `shaders/output_texture.wgsl`.
pub(super) const TEXTURE_FORMAT: TextureFormat = TextureFormat::Rgba16Float;

/// The shared bind group layouts of a device.
#[derive(Debug)]
pub(super) struct Layouts {
    /// Group 1: the sky and its sampler.
    pub(super) sky: BindGroupLayout,
    /// Group 0 of a program that classifies tiles.
    pub(super) classify: BindGroupLayout,
    /// Group 2: the star lists.
    pub(super) star_lists: BindGroupLayout,
    buffer: BindGroupLayout,
    texture: BindGroupLayout,
}

impl Layouts {
    pub(super) fn new(device: &Device) -> Self {
        let layout =
            |label, bindings: &_| bind_group_layout(device, label, ShaderStages::COMPUTE, bindings);
        let (camera, region) = (uniform_binding(false), uniform_binding(true));
        let row = texture_binding(TextureViewDimension::D2, false);
        let written = storage_buffer_binding(false);
        let draw = |label, output| {
            let tiles = storage_buffer_binding(true);
            layout(label, &[camera, region, row, output, tiles])
        };
        Layouts {
            sky: layout(
                "sky",
                &[
                    texture_binding(TextureViewDimension::Cube, true),
                    BindingType::Sampler(SamplerBindingType::Filtering),
                ],
            ),
            classify: layout("classify_tiles", &[camera, region, row, written, written]),
            star_lists: layout(
                "lists of stars",
                &[storage_buffer_binding(true), uint_texture_binding()],
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
