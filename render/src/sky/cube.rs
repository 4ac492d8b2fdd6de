//! A cube map at one resolution: the directions of its texels, and its seamless bilinear filter.

use glam::{Vec3, Vec4};
use half::f16;
use half::slice::HalfFloatSliceExt;
use rayon::prelude::*;

/// A cube map of linear RGB light, in the layout of a GPU texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Cube {
    face_texels: u32,
    texels: Vec<[f16; 4]>,
}

/// Directions in which the columns and rows of a face run, and the direction of its centre.
#[derive(Clone, Copy)]
pub(super) struct FaceAxes {
    right: Vec3,
    down: Vec3,
    outward: Vec3,
}

/// The cube map convention of Vulkan and WebGPU, in layer order.
pub(super) const FACES: [FaceAxes; 6] = [
    FaceAxes {
        right: Vec3::NEG_Z,
        down: Vec3::NEG_Y,
        outward: Vec3::X,
    },
    FaceAxes {
        right: Vec3::Z,
        down: Vec3::NEG_Y,
        outward: Vec3::NEG_X,
    },
    FaceAxes {
        right: Vec3::X,
        down: Vec3::Z,
        outward: Vec3::Y,
    },
    FaceAxes {
        right: Vec3::X,
        down: Vec3::NEG_Z,
        outward: Vec3::NEG_Y,
    },
    FaceAxes {
        right: Vec3::X,
        down: Vec3::NEG_Y,
        outward: Vec3::Z,
    },
    FaceAxes {
        right: Vec3::NEG_X,
        down: Vec3::NEG_Y,
        outward: Vec3::NEG_Z,
    },
];

/// Returns the unit direction of the centre of a texel: `face` 0..6 in the order +X −X +Y −Y +Z −Z,
/// `column` and `row` 0..`face_texels`.
///
/// # Panics
///
/// If `face` is above 5.
pub fn texel_direction(face_texels: u32, face: usize, column: u32, row: u32) -> Vec3 {
    FACES[face].texel_direction(face_texels, column, row)
}

/// Returns the face that `dir` points at (0..6 in the order +X −X +Y −Y +Z −Z) and the position on it: u from left
/// to right and v from top to bottom, both 0 to 1. `dir` may have any length but zero. On an edge Z takes
/// precedence over Y and Y over X, as in Vulkan.
#[inline]
pub fn face_coordinates(dir: Vec3) -> (usize, f32, f32) {
    let size = dir.abs();
    let face = if size.z >= size.x && size.z >= size.y {
        4 + usize::from(dir.z < 0.0)
    } else if size.y >= size.x {
        2 + usize::from(dir.y < 0.0)
    } else {
        usize::from(dir.x < 0.0)
    };
    let (u, v) = match face {
        0 => (-dir.z / size.x, -dir.y / size.x),
        1 => (dir.z / size.x, -dir.y / size.x),
        2 => (dir.x / size.y, dir.z / size.y),
        3 => (dir.x / size.y, -dir.z / size.y),
        4 => (dir.x / size.z, -dir.y / size.z),
        _ => (-dir.x / size.z, -dir.y / size.z),
    };
    (face, 0.5 * u + 0.5, 0.5 * v + 0.5)
}

/// Returns the depth of `dir` along the axis of a face, and where it meets the plane of that face: u and v, which
/// are 0 to 1 on the face itself. It meets the plane only if the depth is positive.
#[inline]
pub(super) fn plane_coordinates(face: usize, dir: Vec3) -> (f32, f32, f32) {
    FACES[face].plane_coordinates(dir)
}

impl FaceAxes {
    /// As [`texel_direction`]. Always inlined, to be compiled for the instructions that its caller is compiled for.
    #[inline(always)]
    pub(super) fn texel_direction(&self, face_texels: u32, column: u32, row: u32) -> Vec3 {
        let x = (2.0 * column as f32 + 1.0) / face_texels as f32 - 1.0;
        let y = (2.0 * row as f32 + 1.0) / face_texels as f32 - 1.0;
        (self.outward + x * self.right + y * self.down).normalize()
    }

    /// As [`plane_coordinates`].
    #[inline(always)]
    pub(super) fn plane_coordinates(&self, dir: Vec3) -> (f32, f32, f32) {
        let depth = dir.dot(self.outward);
        let u = 0.5 * (dir.dot(self.right) / depth) + 0.5;
        (depth, u, 0.5 * (dir.dot(self.down) / depth) + 0.5)
    }
}

impl Cube {
    /// Returns the cube map that has the light `light(direction)` at the centre of each texel.
    /// Directions are unit vectors; light outside 0 to 65504 (the largest f16) is clamped, NaN is 0.
    ///
    /// # Panics
    ///
    /// If `face_texels` is 0.
    pub(super) fn from_fn(face_texels: u32, light: impl Fn(Vec3) -> Vec3 + Sync) -> Self {
        Self::from_rows(face_texels, |face, row, texels| {
            for (column, texel) in (0..).zip(texels) {
                *texel = light(texel_direction(face_texels, face, column, row));
            }
        })
    }

    /// As [`Cube::from_fn`], but `fill(directions, light)` fills in the light of many texels at once.
    pub(super) fn from_directions(
        face_texels: u32,
        fill: impl Fn(&[Vec3], &mut [Vec3]) + Sync,
    ) -> Self {
        Self::from_rows(face_texels, |face, row, texels| {
            let columns = 0..face_texels;
            let directions = columns.map(|column| texel_direction(face_texels, face, column, row));
            fill(&directions.collect::<Vec<_>>(), texels);
        })
    }

    /// As [`Cube::from_fn`], but `fill(face, row, texels)` adds the light to a whole row of black texels.
    pub(super) fn from_rows(
        face_texels: u32,
        fill: impl Fn(usize, u32, &mut [Vec3]) + Sync,
    ) -> Self {
        assert!(face_texels > 0, "a face needs at least one texel");
        let n = face_texels as usize;
        // Zeros of the system: each thread is the first to touch the pages that it fills.
        let mut texels: Vec<[f16; 4]> = bytemuck::zeroed_vec(6 * n * n);
        texels.par_chunks_mut(n).enumerate().for_each_init(
            || (vec![Vec3::ZERO; n], vec![[1.0; 4]; n]),
            |(light, clamped), (index, stored)| {
                light.fill(Vec3::ZERO);
                fill(index / n, (index % n) as u32, light);
                store(light, clamped, stored);
            },
        );
        Self {
            face_texels,
            texels,
        }
    }

    /// Texels along the edge of a face, n.
    pub fn face_texels(&self) -> u32 {
        self.face_texels
    }

    /// The texels of a face as bytes, row-major, `[n][n][4]` of f16.
    ///
    /// # Panics
    ///
    /// If `face` is above 5.
    pub fn face_bytes(&self, face: usize) -> &[u8] {
        let texels = self.texels.len() / 6;
        bytemuck::cast_slice(&self.texels[face * texels..(face + 1) * texels])
    }

    /// The 6·n·n texels as linear RGB and A = 1: layer by layer in the order +X −X +Y −Y +Z −Z, each
    /// row by row from the top.
    pub fn texels(&self) -> &[[f16; 4]] {
        &self.texels
    }

    /// Returns the linear RGB light from the direction `dir` (of any length but zero), filtered bilinearly and,
    /// like a GPU's seamless cube map filter, across the edges of the cube.
    #[inline]
    pub fn sample(&self, dir: Vec3) -> Vec3 {
        let (face, u, v) = face_coordinates(dir);
        let n = self.face_texels as f32;
        let (column, x) = floor_and_fraction(u * n - 0.5);
        let (row, y) = floor_and_fraction(v * n - 0.5);
        let inside = 0..self.face_texels as i32 - 1;
        let [a, b, c, d] = if inside.contains(&column) && inside.contains(&row) {
            let first = self.index(face, column as u32, row as u32);
            let below = first + self.face_texels as usize;
            [first, first + 1, below, below + 1].map(|index| self.rgba(index))
        } else {
            self.border_quad(face, column, row)
        };
        a.lerp(b, x).lerp(c.lerp(d, x), y).truncate()
    }

    /// The texels of a row as linear RGB and A = 1.
    pub(super) fn decoded_row(&self, face: usize, row: u32) -> Vec<[f32; 4]> {
        let first = self.index(face, 0, row);
        let stored = &self.texels[first..first + self.face_texels as usize];
        let mut decoded = vec![[0.0; 4]; stored.len()];
        stored
            .as_flattened()
            .convert_to_f32_slice(decoded.as_flattened_mut());
        decoded
    }

    /// The light of the texel at (column, row) and of those to the right, below and below right, if some lie off
    /// the face.
    #[cold]
    fn border_quad(&self, face: usize, column: i32, row: i32) -> [Vec4; 4] {
        let quad = [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(right, down)| self.light_across_edge(face, column + right, row + down));
        // Three faces meet at a corner of the cube: the missing fourth texel is the mean of the other three.
        let corner = quad.iter().flatten().sum::<Vec3>() / 3.0;
        quad.map(|light| light.unwrap_or(corner).extend(1.0))
    }

    /// The light of a texel that may lie one step beyond an edge of its face, on the neighbouring face; `None`
    /// beyond a corner, where there is no texel.
    fn light_across_edge(&self, face: usize, column: i32, row: i32) -> Option<Vec3> {
        let on_face = 0..self.face_texels as i32;
        match (on_face.contains(&column), on_face.contains(&row)) {
            (true, true) => Some(self.light(self.index(face, column as u32, row as u32))),
            (false, false) => None,
            _ => Some(self.light(self.neighbour(face, column, row))),
        }
    }

    /// Index of the texel one step beyond an edge of the face.
    fn neighbour(&self, face: usize, column: i32, row: i32) -> usize {
        // On a cube of edge 2n, texel centres lie 2 apart and 1 from the edges of their face. The texel sought is
        // on the plane of the neighbouring face, 1 below the shared edge.
        let n = self.face_texels as f32;
        let axes = &FACES[face];
        let centre = |index: i32| (2.0 * index as f32 + 1.0 - n).clamp(-n, n);
        let (face, u, v) = face_coordinates(
            (n - 1.0) * axes.outward + centre(column) * axes.right + centre(row) * axes.down,
        );
        self.index(face, (u * n) as u32, (v * n) as u32)
    }

    pub(super) fn index(&self, face: usize, column: u32, row: u32) -> usize {
        let n = self.face_texels as usize;
        (face * n + row as usize) * n + column as usize
    }

    pub(super) fn light(&self, index: usize) -> Vec3 {
        self.rgba(index).truncate()
    }

    #[inline]
    fn rgba(&self, index: usize) -> Vec4 {
        let [red, green, blue, alpha] = self.texels[index];
        Vec4::new(
            positive_to_f32(red),
            positive_to_f32(green),
            positive_to_f32(blue),
            positive_to_f32(alpha),
        )
    }
}

/// Splits x ≥ −1 into its floor and its fraction. A cast is faster than `f32::floor`. Any other number gives no panic.
pub(super) fn floor_and_fraction(x: f32) -> (i32, f32) {
    let floor = ((x + 1.0) as i32).saturating_sub(1);
    (floor, x - floor as f32)
}

/// Stores a row of light as texels; the alpha of `clamped` is 1.
fn store(light: &[Vec3], clamped: &mut [[f32; 4]], texels: &mut [[f16; 4]]) {
    for (clamped, light) in clamped.iter_mut().zip(light) {
        // `max` and `min` rather than `clamp`, because they turn NaN into 0.
        let limited = |value: f32| value.max(0.0).min(f16::MAX.to_f32_const());
        *clamped = [limited(light.x), limited(light.y), limited(light.z), 1.0];
    }
    let stored = texels.as_flattened_mut();
    stored.convert_from_f32_slice(clamped.as_flattened());
}

/// The value of a finite number ≥ 0, or of −0, exactly: for four numbers at once this is three instructions, where the
/// conversion of `half` asks for each of them whether the processor has one.
#[inline(always)]
fn positive_to_f32(value: f16) -> f32 {
    // The exponents of the two formats differ by 112, also those of subnormal numbers.
    const TWO_TO_112: f32 = f32::from_bits((127 + 112) << 23);
    f32::from_bits(u32::from(value.to_bits() & 0x7fff) << 13) * TWO_TO_112
}

#[cfg(test)]
#[path = "cube_tests.rs"]
mod tests;
