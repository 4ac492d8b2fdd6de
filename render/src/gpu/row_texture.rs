//! The texture of a row.

use super::lookup_shape::LookupShape;
use super::texture::texture;
use crate::lens::Lens;
use lensbake_tables::lookup::RowShape;
use lensbake_tables::{Interpolation, Row, RowFormat};
use wgpu::*;

/// Format of the texture that holds a row of this shape.
pub fn row_texture_format(shape: RowShape) -> TextureFormat {
    match (shape.format, shape.interpolation) {
        (RowFormat::Float32, Interpolation::Linear) => TextureFormat::R32Float,
        (RowFormat::Float32, Interpolation::Hermite) => TextureFormat::Rg32Float,
        (RowFormat::Float16, Interpolation::Linear) => TextureFormat::R16Float,
        (RowFormat::Float16, Interpolation::Hermite) => TextureFormat::Rg16Float,
        (RowFormat::Unorm16(_), Interpolation::Linear) => TextureFormat::R16Unorm,
        (RowFormat::Unorm16(_), Interpolation::Hermite) => TextureFormat::Rg16Unorm,
        (RowFormat::Coefficients, _) => TextureFormat::Rgba32Float,
    }
}

/// The texture of a row, and the row that it holds.
#[derive(Debug)]
pub(super) struct RowTexture {
    texture: Texture,
    view: TextureView,
    shown: Option<(LookupShape, Row)>,
}

impl RowTexture {
    /// An empty texture for rows of this shape.
    pub(super) fn new(device: &Device, shape: LookupShape) -> Self {
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
        let (size, format) = shape.texture();
        let texture = texture(device, "row", size, format, usage);
        RowTexture {
            view: texture.create_view(&Default::default()),
            texture,
            shown: None,
        }
    }

    /// Uploads the row of `lens`, unless it is the last one again.
    pub(super) fn show(&mut self, queue: &Queue, lens: &Lens) {
        let shape = LookupShape::of(lens);
        let is_shown = |(old, row): &(LookupShape, Row)| *old == shape && *row == lens.row;
        if self.shown.as_ref().is_some_and(is_shown) {
            return;
        }
        let bytes = shape.texture_bytes(&lens.row);
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(bytes.len() as u32 / self.texture.height()),
            rows_per_image: None,
        };
        let place = self.texture.as_image_copy();
        queue.write_texture(place, &bytes, layout, self.texture.size());
        self.shown = Some((shape, lens.row.clone()));
    }

    /// Whether it has the size and the format of rows of this shape.
    pub(super) fn fits(&self, shape: LookupShape) -> bool {
        let size = [self.texture.width(), self.texture.height()];
        shape.texture() == (size, self.texture.format())
    }

    /// What the shaders read.
    pub(super) fn view(&self) -> &TextureView {
        &self.view
    }
}
