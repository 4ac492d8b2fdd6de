//! The default atlas, shipped in both containers: the table that `bake` writes without arguments.

use crate::{Axis, Header, Measured, Rows, Solver, Table, Texel};
use std::sync::LazyLock;

/// The default atlas as a binary file.
pub const ATLAS_BINARY: &[u8] = include_bytes!("../assets/atlas.lbt");
/// The default atlas as an OpenEXR file.
pub const ATLAS_EXR: &[u8] = include_bytes!("../assets/atlas.exr");

/// Bytes of the checksum at the end of the binary file.
const CHECKSUM: usize = 4;

// The header is repeated in this file and the texels are read without `container`, so that the atlas needs no
// cargo feature. A test compares the result with what `container` reads.
static ATLAS: LazyLock<Table> = LazyLock::new(|| {
    let header = header();
    let texels_end = ATLAS_BINARY.len() - CHECKSUM;
    let bytes = header.texel_count() as usize * size_of::<Texel>();
    let number = |four: &[u8]| f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
    let texels = ATLAS_BINARY[texels_end - bytes..texels_end]
        .chunks_exact(size_of::<Texel>())
        .map(|texel| [number(&texel[..4]), number(&texel[4..])])
        .collect();
    Table::new(header, texels).expect("a test reads the shipped atlas")
});

/// The default atlas: all radii from infinity through the horizon to r = 0.01, in 96 KiB.
pub fn default_atlas() -> &'static Table {
    &ATLAS
}

fn header() -> Header {
    Header {
        axis: Axis::Residual,
        rows: Rows::ThroughHorizon {
            above: 128,
            below: 64,
            r_min: 0.01,
        },
        texels: 64,
        solver: Solver {
            name: "RK4 with step doubling".to_owned(),
            tolerance: 1e-9,
        },
        measured: Measured {
            max_error: 6.976_474_153_930_212e-8,
            rays: 97_917,
            r_min: 1.000_004_249_433_543_3,
            edge_gap: 1e-6,
        },
        measured_below: Some(Measured {
            max_error: 1.324_625_191_667_649_9e-5,
            rays: 48_497,
            r_min: 1.012_257_504_828_962e-2,
            edge_gap: 1e-6,
        }),
    }
}

#[cfg(all(test, feature = "files"))]
mod tests {
    use super::*;
    use crate::container;

    #[test]
    fn the_atlas_is_what_its_files_hold() {
        for file in [ATLAS_BINARY, ATLAS_EXR] {
            assert!(container::from_bytes(file).unwrap() == *default_atlas());
        }
    }
}
