//! What the shaders of the stars read, laid out as `shaders/stars.wgsl` has it. A test holds it to that.

use crate::stars::PointStar;
use crate::stars::draw::Splat;
use crate::stars::images::{Lens, point_distance};
use crate::stars::kernel::REACHES;
use lensbake_tables::Texel;
use lensbake_tables::inverse::{GpuInverseRow, INVERSE_TEXELS, Inverse};

/// Two texels of an inverse row each: a uniform array is made of vectors of four.
pub(super) const INVERSE_PAIRS: usize = INVERSE_TEXELS as usize / 2;

/// The struct `Star`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct GpuStar {
    direction: [f32; 3],
    padding: f32,
    light: [f32; 3],
    padding_2: f32,
}

/// The struct `Piece`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Piece {
    at: [f32; 2],
    kernel: u32,
    padding: f32,
    light: [f32; 3],
    padding_2: f32,
}

/// The struct `Lens`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct GpuLens {
    point_distance: f32,
    candidates: u32,
    pieces: u32,
    padding: u32,
    inverse: Inverse,
    padding_2: [u32; 3],
    texels: [[f32; 4]; INVERSE_PAIRS],
}

impl GpuLens {
    /// `lens` for stars of this angular radius, with so many images and pieces of arcs.
    pub(super) fn new(lens: &Lens, disc_radius: f64, [candidates, pieces]: [u32; 2]) -> Self {
        let row = match lens {
            Lens::Bent(inverse) => Some(GpuInverseRow::new(inverse)),
            Lens::Flat(_) => None,
        };
        GpuLens {
            point_distance: point_distance(disc_radius) as f32,
            candidates,
            pieces,
            padding: 0,
            inverse: row
                .as_ref()
                .map_or_else(bytemuck::Zeroable::zeroed, |row| row.inverse),
            padding_2: [0; 3],
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

/// Which of the kernels reaches so far.
fn kernel_of(reach: f64) -> u32 {
    let found = REACHES.iter().position(|&of| of == reach);
    found.expect("a kernel's reach") as u32
}

#[cfg(test)]
mod tests {
    use super::super::shader;
    use super::*;
    use std::mem::offset_of;

    #[test]
    fn the_layouts_are_the_shaders() {
        let source = shader::lists(shader::BENT);
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let offsets = |of: &str| -> (Vec<u32>, u32) {
            let found = module.types.iter().find_map(|(_, t)| match &t.inner {
                naga::TypeInner::Struct { members, span } if t.name.as_deref() == Some(of) => {
                    Some((members.iter().map(|m| m.offset).collect(), *span))
                }
                _ => None,
            });
            found.unwrap_or_else(|| panic!("no struct {of}"))
        };
        macro_rules! same_layout {
            ($type:ty, $name:literal, $($member:ident),*) => {
                let ours = vec![$(offset_of!($type, $member) as u32),*];
                assert_eq!(offsets($name), (ours, size_of::<$type>() as u32), $name);
            };
        }
        same_layout!(GpuStar, "Star", direction, light);
        same_layout!(Piece, "Piece", at, kernel, light);
        same_layout!(
            GpuLens,
            "Lens",
            point_distance,
            candidates,
            pieces,
            inverse,
            texels
        );
        same_layout!(
            Inverse,
            "Inverse",
            edge,
            scale,
            first_angle,
            first,
            texels_per_v
        );
    }
}
