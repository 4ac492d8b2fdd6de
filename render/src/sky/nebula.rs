//! The built-in nebula.

use glam::Vec3;

use super::Sky;
use super::built_in_stars::{Star, StarLayer};
use super::cube::{Cube, Light};
use super::noise::{Random, smoothstep};
use super::noise_lanes::{LANES, Values, each, fractal, points, ridged};

const SEED: u32 = 7;
const STARS: u32 = 14000;
/// Linear light at the centre of the faintest star.
const FAINTEST_STAR: f32 = 0.018;

/// Colours of the gas, from the emission of oxygen to warm dust.
const COLOURS: [Vec3; 4] = [
    Vec3::new(0.01, 0.52, 0.48),
    Vec3::new(0.05, 0.20, 0.62),
    Vec3::new(0.78, 0.05, 0.34),
    Vec3::new(1.0, 0.44, 0.08),
];
const NIGHT: Vec3 = Vec3::new(0.0010, 0.0014, 0.0032);

/// Returns a sky of glowing gas and some stars, with `face_texels` texels along the edge of a face.
///
/// # Panics
///
/// If `face_texels` is 0.
pub fn nebula(face_texels: u32) -> Sky {
    // The gas has no detail as fine as a texel, so half the resolution is enough.
    let gas = Cube::from_directions(face_texels.div_ceil(2), Gas);
    let stars = StarLayer::new(face_texels, stars(face_texels));
    Sky::from_rows(face_texels, |face, row, texels| {
        for (column, texel) in (0..).zip(texels.iter_mut()) {
            *texel = gas.sample(super::texel_direction(face_texels, face, column, row));
        }
        stars.add_to_row(face, row, texels);
    })
}

fn stars(face_texels: u32) -> Vec<Star> {
    let mut random = Random::new(SEED);
    (0..STARS)
        .map(|_| {
            let direction = random.direction();
            Star::random(&mut random, direction, FAINTEST_STAR, face_texels)
        })
        .collect()
}

/// The gas.
struct Gas;

impl Light for Gas {
    #[inline(always)]
    fn of(&self, directions: &[Vec3; LANES]) -> [Vec3; LANES] {
        gas(directions)
    }
}

/// Light of the gas in unit directions.
#[inline(always)]
fn gas(directions: &[Vec3; LANES]) -> [Vec3; LANES] {
    let point = each(|i| 1.5 * directions[i]);
    let flow_x = fractal(points(|i| point[i] + Vec3::new(3.1, 0.0, 7.7)), 4);
    let flow_y = fractal(points(|i| point[i] + Vec3::new(-5.2, 1.3, 2.9)), 4);
    let flow_z = fractal(points(|i| point[i] + Vec3::new(8.3, -6.1, 0.4)), 4);
    let bent = each(|i| point[i] + 1.1 * Vec3::new(flow_x[i], flow_y[i], flow_z[i]));
    let cloud = fractal(points(|i| bent[i]), 6);
    let density: Values = each(|i| smoothstep(-0.18, 0.70, cloud[i] + 0.5 * flow_z[i]));
    if density == [0.0; LANES] {
        return [NIGHT; LANES];
    }
    let filaments = ridged(points(|i| 1.7 * bent[i] + Vec3::new(0.7, 4.4, -2.2)), 6);
    let dust = fractal(points(|i| 2.2 * bent[i] + Vec3::new(-1.5, 9.2, 3.3)), 6);
    each(|i| {
        if density[i] == 0.0 {
            return NIGHT;
        }
        let (filaments, dust) = (filaments[i], smoothstep(0.05, 0.30, dust[i]));
        let bright = 0.12 + 2.6 * filaments * filaments * filaments;
        let glow = density[i] * bright * (1.0 - 0.85 * dust);
        NIGHT + glow * colour(0.45 + 1.3 * flow_x[i] + 0.7 * flow_y[i])
    })
}

/// The colour at `place`, 0 to 1, along [`COLOURS`].
fn colour(place: f32) -> Vec3 {
    let last = COLOURS.len() - 1;
    let place = place.clamp(0.0, 1.0) * last as f32;
    let below = (place as usize).min(last - 1);
    COLOURS[below].lerp(COLOURS[below + 1], place - below as f32)
}
