//! The sample pixels of a picture.

use crate::camera::Camera;
use glam::DVec3;
use lensbake_tables::Axis;
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// A picture of at most this many pixels is sampled in full.
const ALL: usize = 8192;
/// Number of lattice pixels along the longer side of the picture.
const LATTICE: u32 = 64;
/// Number of rings around the hole, uniform along the table's axis.
const RINGS: u32 = 512;
/// Number of pixels on each ring.
const ROUND: u32 = 12;
/// Golden section: each ring is rotated against the one before by this part of a turn.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// (column, row) of the sample pixels of the picture of `camera`, sorted and without duplicates. A small picture
/// is sampled in full. Samples of a large one are a lattice up to its borders, to cover all pixel spacings, and
/// rings around the hole, dense where the bending changes fast.
pub fn pixels(camera: &Camera) -> Vec<(u32, u32)> {
    if camera.pixels() <= ALL {
        let row = |row| (0..camera.width).map(move |column| (column, row));
        return (0..camera.height).flat_map(row).collect();
    }
    let pixels: BTreeSet<_> = lattice(camera).chain(rings(camera)).collect();
    pixels.into_iter().collect()
}

/// Whether [`pixels`] returns the whole picture.
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
        let axis = Axis::Residual.of(&camera.observer);
        let theta = camera
            .observer
            .view_angle(axis.shadow_coordinate(&camera.observer, q).x);
        (0..ROUND).filter_map(move |i| {
            let azimuth = TAU * (f64::from(i) / f64::from(ROUND) + GOLDEN * f64::from(ring));
            let (sin, cos) = theta.sin_cos();
            let direction = DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), -cos);
            camera.pixel(camera.boosted(direction).0)
        })
    };
    (0..RINGS).flat_map(ring)
}
