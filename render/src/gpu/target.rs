//! What a picture is drawn to.

use super::Region;
use super::layouts::{BAND_FORMAT, TEXTURE_FORMAT};
use super::pass::Pass;
use super::renderer::Renderer;
use super::source::{Output, Store};
use super::texture::texture;
use crate::scene::Sampling;
use wgpu::*;

/// Bytes of a pixel in a [`Store::Buffer`].
const PIXEL: u32 = size_of::<[f32; 4]>() as u32;

/// What a picture is drawn to.
#[derive(Debug)]
pub(super) enum Target {
    /// A compute pass writes each region in turn to this buffer, `[rows][columns][4]` of f32.
    Buffer(Buffer),
    /// A render pass draws each region in turn to the upper left corner of this texture of f32.
    Band(TextureView),
    /// The whole picture, each region in its place.
    Texture(TextureView),
}

impl Target {
    /// A texture for whole pictures of at most this width and height.
    pub(super) fn texture(renderer: &Renderer, size: [u32; 2]) -> Self {
        let samplings = [Sampling::Single, Sampling::Filtered, Sampling::Anisotropic];
        let mut usage = TextureUsages::TEXTURE_BINDING;
        for output in samplings
            .map(Output::Picture)
            .into_iter()
            .chain([Output::Difference])
        {
            usage |= match renderer.pass(output) {
                Pass::Compute => TextureUsages::STORAGE_BINDING,
                Pass::Fragment => TextureUsages::RENDER_ATTACHMENT,
            };
        }
        let device = &renderer.gpu().device;
        let texture = texture(device, "picture", size, TEXTURE_FORMAT, usage);
        Target::Texture(texture.create_view(&Default::default()))
    }

    /// A target for regions of `output` of at most this width and height, to be read back.
    pub(super) fn regions(renderer: &Renderer, output: Output, [width, height]: [u32; 2]) -> Self {
        let device = &renderer.gpu().device;
        match renderer.pass(output) {
            Pass::Compute => Target::Buffer(device.create_buffer(&BufferDescriptor {
                label: Some("pixels"),
                size: u64::from(width) * u64::from(height) * u64::from(PIXEL),
                usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })),
            Pass::Fragment => {
                let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
                let band = texture(device, "pixels", [width, height], BAND_FORMAT, usage);
                Target::Band(band.create_view(&Default::default()))
            }
        }
    }

    /// Where the programs that draw to it write.
    pub(super) fn store(&self) -> Store {
        match self {
            Target::Buffer(_) | Target::Band(_) => Store::Buffer,
            Target::Texture(_) => Store::Texture,
        }
    }

    /// Column and row of the first pixel of `region`, as `shaders/origin_*.wgsl` have it.
    pub(super) fn origin_of(&self, region: &Region) -> [u32; 2] {
        match self {
            Target::Buffer(_) | Target::Band(_) => [0, 0],
            Target::Texture(_) => region.first,
        }
    }

    /// The width and height of the pictures whose star lists it can hold, if it is a texture of whole pictures.
    pub(super) fn room(&self) -> Option<[u32; 2]> {
        match self {
            Target::Buffer(_) | Target::Band(_) => None,
            Target::Texture(view) => Some([view.texture().width(), view.texture().height()]),
        }
    }

    /// What a compute pass binds.
    ///
    /// # Panics
    /// If it was made for a render pass.
    pub(super) fn binding(&self) -> BindingResource<'_> {
        match self {
            Target::Buffer(buffer) => buffer.as_entire_binding(),
            Target::Texture(view) => BindingResource::TextureView(view),
            Target::Band(_) => unreachable!("made for a render pass"),
        }
    }

    /// The texture.
    ///
    /// # Panics
    /// If it is a buffer.
    pub(super) fn view(&self) -> &TextureView {
        match self {
            Target::Texture(view) | Target::Band(view) => view,
            Target::Buffer(_) => unreachable!("made for a compute pass"),
        }
    }

    /// Bytes of the largest region, as [`Target::copy`] lays it out.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Target::Buffer(buffer) => buffer.size(),
            Target::Band(view) | Target::Texture(view) => {
                let texture = view.texture();
                u64::from(row_bytes(texture.width())) * u64::from(texture.height())
            }
        }
    }

    /// Encodes the copy of a region that was drawn last to `to`.
    pub(super) fn copy(&self, encoder: &mut CommandEncoder, region: Region, to: &Buffer) {
        match self {
            Target::Buffer(buffer) => encoder.copy_buffer_to_buffer(buffer, 0, to, 0, to.size()),
            Target::Band(view) | Target::Texture(view) => {
                let layout = TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row_bytes(region.count[0])),
                    rows_per_image: None,
                };
                let size = Extent3d {
                    width: region.count[0],
                    height: region.count[1],
                    depth_or_array_layers: 1,
                };
                let to = TexelCopyBufferInfo { buffer: to, layout };
                encoder.copy_texture_to_buffer(view.texture().as_image_copy(), to, size);
            }
        }
    }

    /// The pixels of a region that was copied, without the padding of its rows.
    pub(super) fn unpadded(&self, copied: Vec<[f32; 4]>, region: Region) -> Vec<[f32; 4]> {
        let [width, height] = region.count.map(|n| n as usize);
        let stride = match self {
            Target::Buffer(_) => width,
            Target::Band(_) | Target::Texture(_) => (row_bytes(region.count[0]) / PIXEL) as usize,
        };
        let mut pixels = copied;
        if stride != width {
            for row in 1..height {
                pixels.copy_within(row * stride..row * stride + width, row * width);
            }
        }
        pixels.truncate(width * height);
        pixels
    }
}

/// Bytes from one row of pixels to the next in a copy of a texture.
fn row_bytes(width: u32) -> u32 {
    (width * PIXEL).next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT)
}
