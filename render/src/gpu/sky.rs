//! The sky as a texture on the device.

use super::bindings::bind_group;
use super::layouts::Layouts;
use crate::scene::Sampling;
use crate::sky::{Cube, Sky};
use wgpu::*;

/// A sky on the device; a clone refers to the same texture.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyOnDevice {
    trilinear: BindGroup,
    anisotropic: BindGroup,
}

/// Largest ratio of the sides of a footprint that the anisotropic filter of the hardware averages over: the largest
/// that a device may offer.
const ANISOTROPY: u16 = 16;
/// Bytes of a texel of the sky.
const SKY_TEXEL: u32 = size_of::<[half::f16; 4]>() as u32;

impl SkyOnDevice {
    /// Uploads `sky` as a cube map with its mip chain, for seamless trilinear filtering.
    pub(super) fn new(device: &Device, queue: &Queue, layouts: &Layouts, sky: &Sky) -> Self {
        let size = |cube: &Cube| Extent3d {
            width: cube.face_texels(),
            height: cube.face_texels(),
            depth_or_array_layers: 6,
        };
        let texture = device.create_texture(&TextureDescriptor {
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
            queue.write_texture(place, bytes, layout, size(cube));
        }
        let view = texture.create_view(&TextureViewDescriptor {
            dimension: Some(TextureViewDimension::Cube),
            ..Default::default()
        });
        let group = |label, anisotropy_clamp| {
            let sampler = device.create_sampler(&SamplerDescriptor {
                label: Some(label),
                mag_filter: FilterMode::Linear,
                min_filter: FilterMode::Linear,
                mipmap_filter: MipmapFilterMode::Linear,
                anisotropy_clamp,
                ..Default::default()
            });
            let resources = [
                BindingResource::TextureView(&view),
                BindingResource::Sampler(&sampler),
            ];
            bind_group(device, label, &layouts.sky, resources)
        };
        SkyOnDevice {
            trilinear: group("sky", 1),
            anisotropic: group("sky, anisotropic", ANISOTROPY),
        }
    }

    /// The bind group of programs that sample the sky in this way.
    pub(super) fn bind_group(&self, sampling: Sampling) -> &BindGroup {
        match sampling {
            Sampling::Single | Sampling::Filtered => &self.trilinear,
            Sampling::Anisotropic => &self.anisotropic,
        }
    }
}
