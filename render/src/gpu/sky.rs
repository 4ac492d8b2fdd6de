//! The sky as a texture on the device.

use super::bindings::bind_group;
use super::layouts::Layouts;
use crate::sky::{Cube, Sky};
use wgpu::*;

/// A sky on the device; a clone refers to the same texture.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyOnDevice {
    pub(super) bind_group: BindGroup,
}

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
        let sampler = device.create_sampler(&SamplerDescriptor {
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
            bind_group: bind_group(device, "sky", &layouts.sky, resources),
        }
    }
}
