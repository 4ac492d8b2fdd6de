//! What a shader is specialised for to look up the bending.

use super::row_texture::row_texture_format;
use super::source::alias_module;
use crate::lens::{Lens, Lookup};
use crate::shaders::Modules;
use lensbake_tables::lookup::{GpuRow, HorizonSide, RowShape};
use lensbake_tables::{Row, StereographicRow};
use wgpu::TextureFormat;

/// The shape of a table's row in the texture that a shader looks it up in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LookupShape {
    /// A row in stereographic coordinates. All have the same size.
    Stereographic(HorizonSide),
    /// The row itself.
    Row(RowShape),
}

impl LookupShape {
    /// The shape that draws through `lens`.
    pub fn of(lens: &Lens) -> Self {
        match lens.lookup {
            Lookup::Stereographic => {
                LookupShape::Stereographic(HorizonSide::of(lens.row.observer()))
            }
            Lookup::Row => LookupShape::Row(lens.row.shape()),
        }
    }

    /// Width, height and format of the texture.
    pub(super) fn texture(self) -> ([u32; 2], TextureFormat) {
        match self {
            LookupShape::Stereographic(_) => {
                (StereographicRow::TEXTURE_SIZE, TextureFormat::Rgba32Float)
            }
            LookupShape::Row(shape) => (shape.texture_size(), row_texture_format(shape)),
        }
    }

    /// The bytes of the texture for `row`, line by line.
    pub(super) fn texture_bytes(self, row: &Row) -> Vec<u8> {
        match self {
            LookupShape::Stereographic(_) => StereographicRow::new(row).texture_bytes(),
            LookupShape::Row(_) => GpuRow::new(row).texture_bytes(),
        }
    }

    /// Defines the module `table`, which has `deflect_lut` and `deflect_lut_patch`, and what it imports.
    pub(super) fn define(self, modules: &mut Modules) {
        let (table, row, side) = match self {
            LookupShape::Stereographic(side) => ("deflect_lut", StereographicRow::wgsl(0, 2), side),
            LookupShape::Row(shape) => ("deflect_row", shape.wgsl(0, 2), shape.side),
        };
        modules.define("table", alias_module(table));
        modules.define("row", row);
        modules.define("row_coordinate", alias_module(side.row_coordinate()));
    }
}
