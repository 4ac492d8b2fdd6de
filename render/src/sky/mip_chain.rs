//! The sky at every resolution: a cube map with its mip chain, down to one texel per face.
//!
//! A texel of a mip level is the mean light, weighted by solid angle, of the texels that it covers in the next
//! finer level. So no level is brighter than another, and the last one holds the mean of each face.

use glam::Vec3;

use super::cube::Cube;

/// A sky of linear RGB light: the cube maps of a mip chain, from fine to coarse.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    levels: Vec<Cube>,
}

impl Sky {
    /// Returns the sky that has the light `light(direction)` at the centre of each texel of its first
    /// level. Directions are unit vectors; light outside 0 to 65504 (the largest f16) is clamped, NaN
    /// is 0.
    ///
    /// # Panics
    ///
    /// If `face_texels` is 0.
    pub fn from_fn(face_texels: u32, light: impl Fn(Vec3) -> Vec3 + Sync) -> Self {
        Cube::from_fn(face_texels, light).into()
    }

    /// As [`Sky::from_fn`], but `fill(face, row, texels)` adds the light to a whole row of black texels.
    pub(super) fn from_rows(
        face_texels: u32,
        fill: impl Fn(usize, u32, &mut [Vec3]) + Sync,
    ) -> Self {
        Cube::from_rows(face_texels, fill).into()
    }

    /// The levels from fine to coarse, each half as wide as the one before, rounded down; the last has
    /// one texel a face.
    pub fn levels(&self) -> &[Cube] {
        &self.levels
    }

    /// Number of levels of a sky with this many texels along the edge of a face of the first level.
    pub fn level_count(face_texels: u32) -> u32 {
        face_texels.max(1).ilog2() + 1
    }

    /// Texels along the edge of a face of the first level, n.
    pub fn face_texels(&self) -> u32 {
        self.levels[0].face_texels()
    }

    /// Returns the linear RGB light from the direction `dir` (of any length but zero), filtered bilinearly and,
    /// like a GPU's seamless cube map filter, across the edges of the cube.
    #[inline]
    pub fn sample(&self, dir: Vec3) -> Vec3 {
        self.levels[0].sample(dir)
    }

    /// As [`Sky::sample`], but interpolated between the two mip levels next to `level`, like a GPU's trilinear
    /// filter. `level` is clamped to the levels of the sky.
    pub fn sample_level(&self, dir: Vec3, level: f32) -> Vec3 {
        let last = self.levels.len() - 1;
        let level = level.clamp(0.0, last as f32);
        let fine = level as usize;
        let light = self.levels[fine].sample(dir);
        let between = level - fine as f32;
        if between == 0.0 {
            return light;
        }
        light.lerp(self.levels[(fine + 1).min(last)].sample(dir), between)
    }
}

impl From<Cube> for Sky {
    /// The sky whose first level is `finest`.
    fn from(finest: Cube) -> Self {
        let mut levels = vec![finest];
        while let Some(coarser) = levels.last().and_then(halved) {
            levels.push(coarser);
        }
        Sky { levels }
    }
}

/// The next coarser level; `None` after the last.
fn halved(fine: &Cube) -> Option<Cube> {
    let from = fine.face_texels();
    if from == 1 {
        return None;
    }
    let to = from / 2;
    let solid_angle = |column: u32, row: u32| {
        let centre = |index: u32| (2.0 * index as f32 + 1.0) / from as f32 - 1.0;
        let (x, y) = (centre(column), centre(row));
        // (1 + x² + y²)^(−3/2) without a library's power, which takes longer than the rest.
        let square = f64::from(1.0 + x * x + y * y);
        (1.0 / (square * square.sqrt())) as f32
    };
    Some(Cube::from_rows(to, |face, row, texels| {
        for (column, texel) in (0..).zip(texels) {
            let (mut light, mut weight) = (Vec3::ZERO, 0.0);
            for (y, part_y) in covered(row, from, to) {
                for (x, part_x) in covered(column, from, to) {
                    let part = part_x * part_y * solid_angle(x, y);
                    light += part * fine.light(fine.index(face, x, y));
                    weight += part;
                }
            }
            *texel = light / weight;
        }
    }))
}

/// The texels out of `from` that texel `index` out of `to` covers in one dimension, and the covered part of each.
fn covered(index: u32, from: u32, to: u32) -> impl Iterator<Item = (u32, f32)> {
    let scale = f64::from(from) / f64::from(to);
    let (start, end) = (f64::from(index) * scale, f64::from(index + 1) * scale);
    let last = (end.ceil() as u32).min(from);
    (start as u32..last).map(move |texel| {
        let (left, right) = (f64::from(texel), f64::from(texel + 1));
        (texel, (right.min(end) - left.max(start)) as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sky::noise::Random;
    use crate::sky::{grid, texel_direction};

    /// Mean light over the sphere of one level.
    fn mean(cube: &Cube) -> Vec3 {
        let n = cube.face_texels();
        let (mut light, mut weight) = (Vec3::ZERO, 0.0);
        for (face, row) in (0..6).flat_map(|face| (0..n).map(move |row| (face, row))) {
            for column in 0..n {
                // |largest component|³ of the unit direction: the solid angle up to a factor.
                let omega = texel_direction(n, face, column, row).abs().max_element();
                light += omega.powi(3) * cube.light(cube.index(face, column, row));
                weight += omega.powi(3);
            }
        }
        light / weight
    }

    #[test]
    fn the_levels_are_as_many_as_announced() {
        for face_texels in [1, 2, 3, 5, 8, 33] {
            let sky = grid(face_texels);
            assert_eq!(sky.levels().len() as u32, Sky::level_count(face_texels));
        }
    }

    #[test]
    fn levels_halve_down_to_one_texel() {
        let sizes = |n| -> Vec<u32> {
            let sky = Sky::from_fn(n, |_| Vec3::ONE);
            sky.levels().iter().map(Cube::face_texels).collect()
        };
        assert_eq!(sizes(16), [16, 8, 4, 2, 1]);
        assert_eq!(sizes(13), [13, 6, 3, 1]);
        assert_eq!(sizes(1), [1]);
    }

    #[test]
    fn every_level_shines_as_bright_as_the_first() {
        for n in [64, 51, 7] {
            let sky = grid(n);
            let whole = mean(&sky.levels()[0]);
            for cube in sky.levels() {
                let off = (mean(cube) - whole).abs().max_element();
                // The solid angles of coarse texels are taken at their middle.
                assert!(off < 0.03 * whole.max_element(), "{}", cube.face_texels());
            }
        }
    }

    #[test]
    fn a_constant_sky_is_constant_at_every_level() {
        let light = Vec3::new(0.25, 1.0, 3.0);
        let sky = Sky::from_fn(11, |_| light);
        let mut random = Random::new(4);
        for i in 0..2000 {
            let sampled = sky.sample_level(random.direction(), i as f32 * 0.003 - 0.5);
            assert!((sampled - light).abs().max_element() < 1e-5);
        }
    }

    #[test]
    fn a_texel_is_the_mean_of_those_it_covers() {
        for (index, from, to, expected) in [
            (1, 8, 4, vec![(2, 1.0), (3, 1.0)]),
            (0, 3, 1, vec![(0, 1.0), (1, 1.0), (2, 1.0)]),
            (0, 5, 2, vec![(0, 1.0), (1, 1.0), (2, 0.5)]),
            (1, 5, 2, vec![(2, 0.5), (3, 1.0), (4, 1.0)]),
        ] {
            assert_eq!(covered(index, from, to).collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn levels_flow_into_each_other_without_a_step() {
        let sky = grid(32);
        let mut random = Random::new(9);
        for _ in 0..200 {
            let dir = random.direction();
            for level in 0..5 {
                let (level, step) = (level as f32, 1e-4);
                let jump = sky.sample_level(dir, level + step) - sky.sample_level(dir, level);
                assert!(jump.abs().max_element() < 2.0 * step);
                let half = sky.sample_level(dir, level + 0.5);
                let mean =
                    0.5 * (sky.sample_level(dir, level) + sky.sample_level(dir, level + 1.0));
                assert!((half - mean).abs().max_element() < 1e-6);
            }
        }
    }

    /// Each level is continuous across the edges of the cube.
    #[test]
    fn no_level_has_a_seam() {
        let sky = grid(16);
        let mut random = Random::new(5);
        for level in 0..5 {
            for _ in 0..500 {
                let mut on_edge = random.direction();
                on_edge.x = on_edge.y.abs().max(on_edge.z.abs()) * on_edge.x.signum();
                let (one, other) = (on_edge * Vec3::new(1.0 + 1e-5, 1.0, 1.0), on_edge);
                let jump =
                    sky.sample_level(one, level as f32) - sky.sample_level(other, level as f32);
                assert!(jump.abs().max_element() < 2e-4, "{on_edge} {level}");
            }
        }
    }
}
