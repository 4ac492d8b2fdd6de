//! The built-in star map with a Milky Way.

use glam::Vec3;

use super::Sky;
use super::built_in_stars::{Star, StarLayer};
use super::cube::Cube;
use super::noise::{Random, fractal, ridged, smoothstep};

const SEED: u32 = 3;
/// Number of stars uniform over the whole sky.
const FIELD_STARS: u32 = 14000;
/// Number of stars concentrated where the clouds of the Milky Way are bright.
const DISC_STARS: u32 = 40000;
/// Linear light at the centre of the faintest stars.
const FAINTEST_FIELD_STAR: f32 = 0.02;
const FAINTEST_DISC_STAR: f32 = 0.01;
/// Linear light of a cloud at which the density of stars is greatest.
const BRIGHTEST_CLOUD: f32 = 0.25;

/// Returns a sky full of stars with a Milky Way, with `face_texels` texels along the edge of a face.
///
/// # Panics
///
/// If `face_texels` is 0.
pub fn starmap(face_texels: u32) -> Sky {
    // The clouds have no detail as fine as a texel, so half the resolution is enough.
    let clouds = Cube::from_fn(face_texels.div_ceil(2), milky_way);
    let stars = StarLayer::new(face_texels, stars(&clouds, face_texels));
    Sky::from_rows(face_texels, |face, row, texels| {
        for (column, texel) in (0..).zip(texels.iter_mut()) {
            *texel = clouds.sample(super::texel_direction(face_texels, face, column, row));
        }
        stars.add_to_row(face, row, texels);
    })
}

fn stars(clouds: &Cube, face_texels: u32) -> Vec<Star> {
    let mut random = Random::new(SEED);
    let mut stars = Vec::new();
    for _ in 0..FIELD_STARS {
        let direction = random.direction();
        stars.push(Star::random(
            &mut random,
            direction,
            FAINTEST_FIELD_STAR,
            face_texels,
        ));
    }
    for _ in 0..DISC_STARS {
        let direction = disc_direction(clouds, &mut random);
        stars.push(Star::random(
            &mut random,
            direction,
            FAINTEST_DISC_STAR,
            face_texels,
        ));
    }
    stars
}

/// A random direction, more probable where the Milky Way is bright (rejection sampling).
fn disc_direction(clouds: &Cube, random: &mut Random) -> Vec3 {
    loop {
        let direction = random.direction();
        if BRIGHTEST_CLOUD * random.unit() < clouds.sample(direction).y {
            return direction;
        }
    }
}

/// The coordinates of `dir` in the galactic frame: towards the centre, along the plane, and towards the pole.
fn galactic(dir: Vec3) -> Vec3 {
    let centre = Vec3::new(0.34, 0.12, -1.0).normalize();
    let pole = centre.cross(Vec3::new(0.85, 0.5, 0.1)).normalize();
    Vec3::new(dir.dot(centre), dir.dot(pole.cross(centre)), dir.dot(pole))
}

/// Smooth density of stars in the disc and bulge, 0 to about 1.
fn density(dir: Vec3) -> f32 {
    let at = galactic(dir);
    let disc = (-at.z.abs() / 0.11).exp() * (0.45 + 0.2 * at.x);
    let bulge_distance = (at - Vec3::X) / Vec3::new(1.0, 0.26, 0.17);
    let bulge = (-0.5 * bulge_distance.length_squared()).exp();
    disc + 0.6 * bulge
}

/// Light of the unresolved stars behind the dust, in a unit direction.
fn milky_way(dir: Vec3) -> Vec3 {
    let at = galactic(dir);
    let flow = Vec3::new(
        fractal(3.0 * at + Vec3::new(1.7, 0.2, 5.1), 4),
        fractal(3.0 * at + Vec3::new(-4.0, 7.3, 0.6), 4),
        fractal(3.0 * at + Vec3::new(2.2, -3.9, 8.8), 4),
    );
    let bent = 4.5 * at + 0.7 * flow;
    let mottle = (1.0 + 1.3 * fractal(2.0 * bent, 6)).max(0.0);
    let near_plane = (-((at.z + 0.09 * flow.z) / 0.085).powi(2)).exp();
    let depth = if near_plane < 0.005 {
        0.0
    } else {
        3.2 * near_plane * dust(bent)
    };
    // Dust lets red light through better than blue.
    let through = (-depth * Vec3::new(0.75, 1.0, 1.3)).map(f32::exp);
    let warmth = smoothstep(0.3, 1.0, density(dir));
    let starlight = Vec3::new(0.62, 0.77, 1.0).lerp(Vec3::new(1.0, 0.80, 0.56), warmth);
    let base = Vec3::new(0.0012, 0.0015, 0.0026);
    base + 0.38 * density(dir).powf(1.4) * mottle * starlight * through
}

/// Amount of dust at a point, 0 to 1.
fn dust(point: Vec3) -> f32 {
    let lanes = ridged(point + Vec3::new(6.6, -2.4, 1.9), 6) + 0.8 * fractal(point, 5);
    smoothstep(0.1, 0.9, lanes)
}
