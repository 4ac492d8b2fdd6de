//! The pixels that stand for a picture.

use crate::camera::Camera;
use glam::DVec3;
use lensbake_tables::Axis;
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// A picture of no more pixels stands for itself.
const ALL: usize = 8192;
/// Pixels of the lattice along the longer side of the picture.
const LATTICE: u32 = 64;
/// Rings about the hole, uniform along the table's axis, and pixels on each.
const RINGS: u32 = 512;
const ROUND: u32 = 12;
/// The golden section, by which each ring is turned against the last.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// (column, row) of the pixels that stand for the picture of `camera`: all of a small one; of a large
/// one a lattice up to its borders, for its pixel angles, and rings about the hole, dense where the
/// bending changes fast. In order and each once.
pub fn pixels(camera: &Camera) -> Vec<(u32, u32)> {
    if camera.pixels() <= ALL {
        let row = |row| (0..camera.width).map(move |column| (column, row));
        return (0..camera.height).flat_map(row).collect();
    }
    let pixels: BTreeSet<_> = lattice(camera).chain(rings(camera)).collect();
    pixels.into_iter().collect()
}

/// Whether [`pixels`] is the whole picture.
pub fn are_all(camera: &Camera) -> bool {
    camera.pixels() <= ALL
}

/// Distance between neighbours in the lattice, pixels.
pub fn spacing(camera: &Camera) -> u32 {
    camera.width.max(camera.height).div_ceil(LATTICE)
}

fn lattice(camera: &Camera) -> impl Iterator<Item = (u32, u32)> {
    let spacing = spacing(camera) as usize;
    let along = move |side: u32| (0..side).step_by(spacing).chain([side - 1]);
    let width = camera.width;
    along(camera.height).flat_map(move |row| along(width).map(move |column| (column, row)))
}

fn rings(camera: &Camera) -> impl Iterator<Item = (u32, u32)> {
    let ring = move |ring: u32| {
        let q = (f64::from(ring) + 0.5) / f64::from(RINGS);
        let theta = camera.observer.view_angle(Axis::Residual.coordinate(q).x);
        (0..ROUND).filter_map(move |i| {
            let azimuth = TAU * (f64::from(i) / f64::from(ROUND) + GOLDEN * f64::from(ring));
            let (sin, cos) = theta.sin_cos();
            let direction = DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), -cos);
            camera.pixel(direction)
        })
    };
    (0..RINGS).flat_map(ring)
}
