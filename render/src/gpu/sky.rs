//! The sky as a texture on the device.

use super::bindings::bind_group;
use super::layouts::Layouts;
use crate::scene::Sampling;
#[cfg(doc)]
use crate::sky::Cube;
use crate::sky::Sky;
use wgpu::*;

/// A sky on the device; a clone refers to the same texture.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyOnDevice {
    /// The first mip level alone: a driver need not find a level for each ray.
    bilinear: BindGroup,
    trilinear: BindGroup,
    anisotropic: BindGroup,
}

/// Largest ratio of the sides of a footprint that the anisotropic filter of the hardware averages over: the largest
/// that a device may offer.
const ANISOTROPY: u16 = 16;
/// Bytes of a texel of the sky.
const SKY_TEXEL: u32 = size_of::<[half::f16; 4]>() as u32;

/// A sky on the device that is written face by face, as a program does that gets it in parts.
#[derive(Debug)]
pub struct SkyUpload {
    queue: Queue,
    texture: Texture,
    sky: SkyOnDevice,
}

impl SkyUpload {
    /// Room for a cube map of this many texels along the edge of a face, and its mip chain.
    pub(super) fn new(device: &Device, queue: &Queue, layouts: &Layouts, face_texels: u32) -> Self {
        use MipmapFilterMode::{Linear, Nearest};
        let texture = device.create_texture(&TextureDescriptor {
            label: Some("sky"),
            size: Extent3d {
                width: face_texels,
                height: face_texels,
                depth_or_array_layers: 6,
            },
            mip_level_count: Sky::level_count(face_texels),
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: TextureFormat::Rgba16Float,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = |mip_level_count| {
            texture.create_view(&TextureViewDescriptor {
                dimension: Some(TextureViewDimension::Cube),
                mip_level_count,
                ..Default::default()
            })
        };
        let (first_level, all_levels) = (view(Some(1)), view(None));
        // Filtering is seamless.
        let group = |label, view, mipmap_filter, anisotropy_clamp| {
            let sampler = device.create_sampler(&SamplerDescriptor {
                label: Some(label),
                mag_filter: FilterMode::Linear,
                min_filter: FilterMode::Linear,
                mipmap_filter,
                anisotropy_clamp,
                ..Default::default()
            });
            let resources = [
                BindingResource::TextureView(view),
                BindingResource::Sampler(&sampler),
            ];
            bind_group(device, label, &layouts.sky, resources)
        };
        let sky = SkyOnDevice {
            bilinear: group("sky, one level", &first_level, Nearest, 1),
            trilinear: group("sky", &all_levels, Linear, 1),
            anisotropic: group("sky, anisotropic", &all_levels, Linear, ANISOTROPY),
        };
        SkyUpload {
            queue: queue.clone(),
            texture,
            sky,
        }
    }

    /// Writes a face of a mip level, in the order of [`Cube::texels`]; false if there is no such face, or `texels` are
    /// not all of its bytes.
    #[must_use]
    pub fn write(&self, level: u32, face: u32, texels: &[u8]) -> bool {
        if level >= self.texture.mip_level_count() || face >= 6 {
            return false;
        }
        let side = (self.texture.width() >> level).max(1);
        if texels.len() as u64 != u64::from(SKY_TEXEL) * u64::from(side) * u64::from(side) {
            return false;
        }
        let place = TexelCopyTextureInfo {
            mip_level: level,
            origin: Origin3d {
                x: 0,
                y: 0,
                z: face,
            },
            ..self.texture.as_image_copy()
        };
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(SKY_TEXEL * side),
            rows_per_image: Some(side),
        };
        let size = Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: 1,
        };
        self.queue.write_texture(place, texels, layout, size);
        true
    }

    /// The sky, of which all faces have been written.
    pub fn finish(self) -> SkyOnDevice {
        self.sky
    }
}

impl SkyOnDevice {
    /// Uploads `sky` as a cube map with its mip chain.
    pub(super) fn new(device: &Device, queue: &Queue, layouts: &Layouts, sky: &Sky) -> Self {
        let upload = SkyUpload::new(device, queue, layouts, sky.face_texels());
        for (level, cube) in (0..).zip(sky.levels()) {
            for face in 0..6 {
                let written = upload.write(level, face as u32, cube.face_bytes(face));
                debug_assert!(written, "level {level} of the sky has another size");
            }
        }
        upload.finish()
    }
    /// The bind group of programs that sample the sky in this way.
    pub(super) fn bind_group(&self, sampling: Sampling) -> &BindGroup {
        match sampling {
            Sampling::Single => &self.bilinear,
            Sampling::Filtered => &self.trilinear,
            Sampling::Anisotropic => &self.anisotropic,
        }
    }
}
