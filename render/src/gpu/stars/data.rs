//! The structs that the star shaders read. A test compares their layouts with those that naga computes for the
//! shaders.

use crate::stars::PointStar;
use crate::stars::Splat;
use crate::stars::images::{InverseLens, point_distance};
use crate::stars::kernel::REACHES;
use lensbake_tables::Texel;
use lensbake_tables::inverse::{GpuInverseRow, INVERSE_TEXELS, Inverse};

/// Number of vectors that hold the texels of an inverse row, two in each, because a uniform array has a stride of
/// 16 bytes.
pub(super) const INVERSE_PAIRS: usize = INVERSE_TEXELS as usize / 2;

/// The struct `Star` of `shaders/list_stars.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct GpuStar {
    direction: [f32; 3],
    padding: f32,
    light: [f32; 3],
    padding_2: f32,
}

/// The struct `Piece` of `shaders/list_pieces.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Piece {
    at: [f32; 2],
    kernel: u32,
    padding: f32,
    light: [f32; 3],
    padding_2: f32,
}

/// The struct `InverseLens` of `shaders/inverse_lens.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct InverseLensBlock {
    point_distance: f32,
    candidates: u32,
    pieces: u32,
    padding: u32,
    inverse: Inverse,
    padding_2: [u32; 2],
    texels: [[f32; 4]; INVERSE_PAIRS],
}

impl InverseLensBlock {
    /// The block of `lens`, for stars of angular radius `disc_radius` (rad) and with these numbers of candidates
    /// and pieces of arcs.
    pub(super) fn new(
        lens: &InverseLens,
        disc_radius: f64,
        [candidates, pieces]: [u32; 2],
    ) -> Self {
        let row = match lens {
            InverseLens::Bent(inverse) => Some(GpuInverseRow::new(inverse)),
            InverseLens::Flat(_) => None,
        };
        InverseLensBlock {
            point_distance: point_distance(disc_radius) as f32,
            candidates,
            pieces,
            padding: 0,
            inverse: row
                .as_ref()
                .map_or_else(bytemuck::Zeroable::zeroed, |row| row.inverse),
            padding_2: [0; 2],
            texels: row.map_or_else(bytemuck::Zeroable::zeroed, |row| pairs(&row.texels)),
        }
    }
}

fn pairs(texels: &[Texel]) -> [[f32; 4]; INVERSE_PAIRS] {
    std::array::from_fn(|i| {
        let ([a, b], [c, d]) = (texels[2 * i], texels[2 * i + 1]);
        [a, b, c, d]
    })
}

impl From<&PointStar> for GpuStar {
    fn from(star: &PointStar) -> Self {
        GpuStar {
            direction: star.direction.as_vec3().to_array(),
            padding: 0.0,
            light: star.light.to_array(),
            padding_2: 0.0,
        }
    }
}

impl From<&Splat> for Piece {
    fn from(splat: &Splat) -> Self {
        Piece {
            at: splat.at.as_vec2().to_array(),
            kernel: kernel_of(splat.reach),
            padding: 0.0,
            light: splat.light.to_array(),
            padding_2: 0.0,
        }
    }
}

/// Index of the kernel with the half-width `reach`.
fn kernel_of(reach: f64) -> u32 {
    let found = REACHES.iter().position(|&of| of == reach);
    found.expect("a kernel's reach") as u32
}

#[cfg(test)]
mod tests {
    use super::super::programs::tests::{bent_source, pieces_source};
    use super::*;
    use crate::shaders::layouts::assert_layout;

    #[test]
    fn the_layouts_are_the_shaders() {
        let source = bent_source();
        assert_layout!(&source, "Star", GpuStar, direction, light);
        assert_layout!(&pieces_source(), "Piece", Piece, at, kernel, light);
        assert_layout!(
            &source,
            "InverseLens",
            InverseLensBlock,
            point_distance,
            candidates,
            pieces,
            inverse,
            texels,
        );
        assert_layout!(
            &source,
            "Inverse",
            Inverse,
            edge,
            centre,
            scale,
            first_angle,
            first,
            texels_per_v,
        );
    }
}
