//! Stars of the built-in skies: Gaussian dots on the sphere, drawn into the rows of a cube map.

use std::ops::Range;

use glam::Vec3;

use super::cube::plane_coordinates;
use super::noise::Random;
use super::{BUILT_IN_FACE_TEXELS, texel_direction};

/// Standard deviation of the dot of a faint star, in texels at the centre of a face.
const SIGMA_TEXELS: f32 = 0.72;
/// A dot ends at this many standard deviations, where its light has fallen to 1/3000.
const REACH_SIGMAS: f32 = 4.0;
/// Light at the centre of the brightest dots; brighter stars get a wider dot instead.
const PEAK: f32 = 1.6;
/// Light of the brightest star before its dot is widened.
const MAX_LIGHT: f32 = 60.0;
/// The dot of a star above [`PEAK`] widens as its light to this power.
const WIDENING: f32 = 0.2;
/// The number of stars brighter than L falls as L to this power, as for stars distributed evenly in space.
const COUNT_SLOPE: f32 = -1.5;
/// Colours from cool to hot stars.
const COLOURS: [Vec3; 5] = [
    Vec3::new(1.0, 0.42, 0.14),
    Vec3::new(1.0, 0.74, 0.47),
    Vec3::new(1.0, 0.96, 0.92),
    Vec3::new(0.62, 0.77, 1.0),
    Vec3::new(0.40, 0.57, 1.0),
];

/// A star as a Gaussian dot on the sphere.
pub(super) struct Star {
    direction: Vec3,
    /// Linear light at its centre.
    peak: Vec3,
    /// Standard deviation, rad.
    sigma: f32,
}

impl Star {
    /// A random star in `direction`. `faintest` is the least light it may have in a cube map of
    /// [`BUILT_IN_FACE_TEXELS`]; at another resolution its dot has another size but the same total light.
    pub(super) fn random(
        random: &mut Random,
        direction: Vec3,
        faintest: f32,
        face_texels: u32,
    ) -> Self {
        let finer = face_texels as f32 / BUILT_IN_FACE_TEXELS as f32;
        let light = faintest * (1.0 - random.unit()).powf(1.0 / COUNT_SLOPE);
        let light = finer * finer * light.min(MAX_LIGHT);
        let peak = light.min(PEAK);
        let texel = 2.0 / face_texels as f32;
        Self {
            direction,
            peak: peak * colour(random.unit()),
            sigma: SIGMA_TEXELS * texel * (light / peak).powf(WIDENING),
        }
    }
}

/// Stars indexed by the rows of the cube map that they touch.
pub(super) struct StarLayer {
    face_texels: u32,
    stars: Vec<Star>,
    /// For each row of each face, the indices of its stars with the columns that they touch.
    rows: Vec<Vec<(usize, Range<u32>)>>,
}

impl StarLayer {
    pub(super) fn new(face_texels: u32, stars: Vec<Star>) -> Self {
        let mut rows = vec![Vec::new(); 6 * face_texels as usize];
        for (index, star) in stars.iter().enumerate() {
            for face in 0..6 {
                let Some((columns, touched)) = extent(star, face, face_texels) else {
                    continue;
                };
                for row in touched {
                    rows[face * face_texels as usize + row as usize].push((index, columns.clone()));
                }
            }
        }
        Self {
            face_texels,
            stars,
            rows,
        }
    }

    /// Adds the light of the stars to a row of texels.
    pub(super) fn add_to_row(&self, face: usize, row: u32, texels: &mut [Vec3]) {
        for (index, columns) in &self.rows[face * self.face_texels as usize + row as usize] {
            let star = &self.stars[*index];
            for column in columns.clone() {
                let dir = texel_direction(self.face_texels, face, column, row);
                let distance = dir.distance_squared(star.direction) / (star.sigma * star.sigma);
                texels[column as usize] += star.peak * (-0.5 * distance).exp();
            }
        }
    }
}

/// Columns and rows of a face that the dot of a star may touch.
fn extent(star: &Star, face: usize, face_texels: u32) -> Option<(Range<u32>, Range<u32>)> {
    let (depth, u, v) = plane_coordinates(face, star.direction);
    // A face has depth 1/√3 at its corners, its least; the rest is the margin for the dot.
    if depth < 0.4 {
        return None;
    }
    // An angle takes at most 1/depth² as much of the plane as in the centre of the face.
    let reach = 0.5 * REACH_SIGMAS * star.sigma / (depth * depth);
    let texels = |at: f32| {
        let n = face_texels as f32;
        let bound = |edge: f32| (edge * n).clamp(0.0, n) as u32;
        bound(at - reach)..bound(at + reach + 1.0 / n)
    };
    let (columns, rows) = (texels(u), texels(v));
    (!columns.is_empty() && !rows.is_empty()).then_some((columns, rows))
}

/// Colour of a star, for `rank` 0 (coolest) to 1 (hottest).
fn colour(rank: f32) -> Vec3 {
    let place = rank * (COLOURS.len() - 1) as f32;
    let below = (place as usize).min(COLOURS.len() - 2);
    COLOURS[below].lerp(COLOURS[below + 1], place - below as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sky::Sky;

    #[test]
    fn a_star_is_round_wherever_it_stands() {
        let n = 128;
        let sigma = 3.0 * 2.0 / n as f32;
        let mut rings = 0;
        for direction in [
            Vec3::X,
            Vec3::new(0.3, -1.0, 0.8),
            Vec3::new(1.0, 1.0, 0.2),
            Vec3::new(0.4, -1.0, -1.0),
            Vec3::new(-0.99, 0.1, 1.0),
            Vec3::ONE,
            Vec3::new(1.0, -0.98, -0.99),
        ] {
            let direction = direction.normalize();
            let star = Star {
                direction,
                peak: Vec3::ONE,
                sigma,
            };
            let layer = StarLayer::new(n, vec![star]);
            let sky = Sky::from_rows(n, |face, row, texels| layer.add_to_row(face, row, texels));
            assert!((sky.sample(direction).x - 1.0).abs() < 0.06, "{direction}");
            let (side, up) = direction.any_orthonormal_pair();
            for turn in 0..64 {
                let (sin, cos) = (turn as f32 / 64.0 * std::f32::consts::TAU).sin_cos();
                for radius in [0.5, 1.0, 2.0, 3.0] {
                    let aside = radius * sigma * (cos * side + sin * up);
                    let light = sky.sample(direction + aside).x;
                    let expected = (-0.5 * radius * radius).exp();
                    assert!(
                        (light - expected).abs() < 0.06,
                        "{direction} {radius}: {light}"
                    );
                    rings += 1;
                }
            }
        }
        assert_eq!(rings, 7 * 64 * 4);
    }

    #[test]
    fn a_dot_ends_only_where_it_is_dark() {
        // A star near a corner of the cube adds the value of its Gaussian at each texel.
        let n = 64;
        let direction = Vec3::new(1.0, 0.97, -0.95).normalize();
        let sigma = 2.0 * 2.0 / n as f32;
        let layer = StarLayer::new(
            n,
            vec![Star {
                direction,
                peak: Vec3::ONE,
                sigma,
            }],
        );
        let mut missing = 0.0_f32;
        for (face, row) in (0..6).flat_map(|face| (0..n).map(move |row| (face, row))) {
            let mut texels = vec![Vec3::ZERO; n as usize];
            layer.add_to_row(face, row, &mut texels);
            for (column, texel) in (0..).zip(texels) {
                let dir = texel_direction(n, face, column, row);
                let distance = dir.distance(direction) / sigma;
                missing = missing.max((-0.5 * distance * distance).exp() - texel.x);
            }
        }
        assert!(missing < 4e-4, "{missing}");
        assert!(missing > 0.0, "the dot must end somewhere");
    }
}
