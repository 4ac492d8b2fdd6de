//! The built-in star map with a Milky Way.

use glam::Vec3;

use super::Sky;
use super::built_in_stars::{Star, StarLayer};
use super::cube::Cube;
use super::noise::{Random, smoothstep};
use super::octaves::{fractal, ridged};

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
    let clouds = Cube::from_directions(face_texels.div_ceil(2), milky_way);
    let stars = StarLayer::new(face_texels, stars(&clouds, face_texels));
    Sky::from_rows(face_texels, |face, row, texels| {
        clouds.sample_row(face_texels, face, row, texels);
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

/// Light of the unresolved stars behind the dust, in unit directions.
fn milky_way(directions: &[Vec3], light: &mut [Vec3]) {
    let at: Vec<Vec3> = directions.iter().map(|&dir| galactic(dir)).collect();
    let flow = |shift: Vec3| fractal(at.iter().map(|at| 3.0 * at + shift), 4);
    let flow = [
        flow(Vec3::new(1.7, 0.2, 5.1)),
        flow(Vec3::new(-4.0, 7.3, 0.6)),
        flow(Vec3::new(2.2, -3.9, 8.8)),
    ];
    let flow = |i: usize| Vec3::new(flow[0][i], flow[1][i], flow[2][i]);
    let bent: Vec<Vec3> = (0..at.len()).map(|i| 4.5 * at[i] + 0.7 * flow(i)).collect();
    let mottle = fractal(bent.iter().map(|bent| 2.0 * bent), 6);

    // There is dust only near the plane.
    let near_plane = |i: usize| (-((at[i].z + 0.09 * flow(i).z) / 0.085).powi(2)).exp();
    let dusty: Vec<usize> = (0..at.len()).filter(|&i| near_plane(i) >= 0.005).collect();
    let mut depth = vec![0.0; at.len()];
    let dust = dust(dusty.iter().map(|&i| bent[i]));
    for (&i, dust) in dusty.iter().zip(dust) {
        depth[i] = 3.2 * near_plane(i) * dust;
    }
    for (i, light) in light.iter_mut().enumerate() {
        let dir = directions[i];
        let mottle = (1.0 + 1.3 * mottle[i]).max(0.0);
        // Dust lets red light through better than blue.
        let through = (-depth[i] * Vec3::new(0.75, 1.0, 1.3)).map(f32::exp);
        let density = density(dir);
        let warmth = smoothstep(0.3, 1.0, density);
        let starlight = Vec3::new(0.62, 0.77, 1.0).lerp(Vec3::new(1.0, 0.80, 0.56), warmth);
        let base = Vec3::new(0.0012, 0.0015, 0.0026);
        *light = base + 0.38 * density.powf(1.4) * mottle * starlight * through;
    }
}

/// Amount of dust at points, 0 to 1.
fn dust(points: impl Iterator<Item = Vec3> + Clone) -> impl Iterator<Item = f32> {
    let lanes = ridged(
        points
            .clone()
            .map(|point| point + Vec3::new(6.6, -2.4, 1.9)),
        6,
    );
    let lanes = lanes.into_iter().zip(fractal(points, 5));
    lanes.map(|(ridged, fractal)| smoothstep(0.1, 0.9, ridged + 0.8 * fractal))
}
