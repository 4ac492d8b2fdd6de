//! Light that falls on a point of the picture, distributed over its pixels.

use super::kernel::{CORE, weight};
use crate::camera::{Camera, Mapping};
use crate::picture::Picture;
use glam::{DVec2, Vec3};
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

/// Light that falls on a point of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Splat {
    /// Position in pixels from the picture's top left corner.
    pub at: DVec2,
    /// Half-width of its point-spread kernel, pixels.
    pub reach: f64,
    /// Its light, linear RGB.
    pub light: Vec3,
}

/// Least solid angle of a pixel of a fisheye by which the light of a star is divided, in units of that of a pixel in the
/// centre. The whole rim of a disc of 360° is one direction.
const LEAST_SOLID_ANGLE: f64 = 0.1;

impl Splat {
    /// Whether its kernel may touch the picture of `camera`.
    pub(super) fn may_touch(&self, camera: &Camera) -> bool {
        let size = DVec2::new(camera.width.into(), camera.height.into());
        let margin = DVec2::splat(widened(self, camera));
        let around = camera.mapping == Mapping::Equirectangular;
        around || (self.at.cmpgt(-margin).all() && self.at.cmplt(size + margin).all())
    }
}

/// The pixels of one side of a picture that `reach` covers around `at`.
fn covered(at: f64, reach: f64, side: u32) -> Range<u32> {
    let bound = |edge: f64| edge.clamp(0.0, side.into()) as u32;
    bound(at - reach)..bound(at + reach + 1.0)
}

/// The centre of a pixel, in pixels from the picture's top left corner.
fn middle(column: f64, row: u32) -> DVec2 {
    DVec2::new(column, row.into()) + 0.5
}

/// Adds a splat to a picture in perspective.
pub(super) fn add(picture: &mut Picture, splat: &Splat) {
    add_covered(picture, splat, |_, _| 1.0);
}

/// Adds a splat to a picture of which `share(column, row)` is the covered share of a pixel.
fn add_covered(picture: &mut Picture, splat: &Splat, share: impl Fn(u32, u32) -> f64) {
    let (width, height) = (picture.width(), picture.height());
    for row in covered(splat.at.y, splat.reach, height) {
        for column in covered(splat.at.x, splat.reach, width) {
            let offset = middle(column.into(), row) - splat.at;
            let weight = weight(offset, splat.reach) * share(column, row);
            picture.add(column, row, (splat.light * weight as f32).to_array());
        }
    }
}

/// Adds a splat to a picture whose pixels differ in solid angle. The light per solid angle is that of a pixel in the
/// centre, wherever the star is: the kernels are as wide on the sphere as there.
pub(super) fn add_curved(picture: &mut Picture, splat: &Splat, camera: &Camera) {
    match camera.mapping {
        _ if splat.reach > CORE => add_halo(picture, splat, camera),
        Mapping::Equirectangular => add_wide_core(picture, splat, camera),
        Mapping::Perspective | Mapping::Equidistant => {
            let solid_angle = camera.pixel_solid_angle(from_centre(splat.at, camera));
            let light = splat.light / solid_angle.max(LEAST_SOLID_ANGLE) as f32;
            let share = |column, row| camera.coverage(column, row);
            add_covered(picture, &Splat { light, ..*splat }, share);
        }
    }
}

/// A point of the picture in pixels from its centre.
fn from_centre(at: DVec2, camera: &Camera) -> DVec2 {
    at - 0.5 * DVec2::new(camera.width.into(), camera.height.into())
}

/// Adds the core of a star to an equirectangular picture: it is wider by 1 over the cosine of the latitude.
fn add_wide_core(picture: &mut Picture, splat: &Splat, camera: &Camera) {
    let width = f64::from(camera.width);
    let cos = camera.pixel_solid_angle(from_centre(splat.at, camera));
    // No wider than the picture.
    let narrowed = cos.max(2.0 * CORE / width);
    let half = (CORE / narrowed).min(0.5 * width);
    let first = splat.at.x - 0.5;
    let columns = (first - half).ceil() as i64..(first + half).ceil() as i64;
    let along = |column: i64| (column as f64 + 0.5 - splat.at.x) * narrowed;
    let across = |y: f64| weight(DVec2::new(0.0, y), CORE) / weight(DVec2::ZERO, CORE);
    let right: Vec<f64> = columns
        .clone()
        .map(|column| across(along(column)))
        .collect();
    let rows = covered(splat.at.y, splat.reach, camera.height);
    let down = rows.map(|row| (row, across(f64::from(row) + 0.5 - splat.at.y)));
    let down: Vec<(u32, f64)> = down.collect();
    // The weights of a widened spline do not quite add up to one.
    let solid_angle = |row| camera.pixel_solid_angle(camera.position(0, row));
    let light: f64 = down
        .iter()
        .map(|&(row, weight)| weight * solid_angle(row))
        .sum();
    let sum = light * right.iter().sum::<f64>();
    if sum == 0.0 {
        return;
    }
    for (column, right) in columns.zip(right) {
        let column = column.rem_euclid(camera.width.into()) as u32;
        for &(row, down) in &down {
            let share = (right * down / sum) as f32;
            picture.add(column, row, (splat.light * share).to_array());
        }
    }
}

/// Adds a halo, which is round on the sphere.
fn add_halo(picture: &mut Picture, splat: &Splat, camera: &Camera) {
    let ray = |at: DVec2| camera.ray(from_centre(at, camera));
    let star = ray(splat.at);
    for row in rows(splat, camera) {
        for column in columns(splat, camera, row) {
            let apart = (ray(middle(column as f64, row)) - star).length() / camera.right.length();
            let column_in = column.rem_euclid(camera.width.into()) as u32;
            let weight = weight(DVec2::new(apart, 0.0), splat.reach);
            let share = (weight * camera.coverage(column_in, row)) as f32;
            picture.add(column_in, row, (splat.light * share).to_array());
        }
    }
}

/// The rows that a halo may touch. Around the centre of a fisheye, pixels are narrower than in its centre.
fn rows(splat: &Splat, camera: &Camera) -> Range<u32> {
    covered(splat.at.y, widened(splat, camera), camera.height)
}

/// The half-width of a halo where it is widest in pixels, along the rim of a fisheye.
fn widened(splat: &Splat, camera: &Camera) -> f64 {
    match camera.mapping {
        Mapping::Equidistant => {
            let solid_angle = camera.pixel_solid_angle(from_centre(splat.at, camera));
            // Its far side may lie nearer to the rim.
            splat.reach / (0.5 * solid_angle).max(LEAST_SOLID_ANGLE)
        }
        Mapping::Perspective | Mapping::Equirectangular => splat.reach,
    }
}

/// The columns that a halo may touch in a row. Those of an equirectangular picture go on beyond its edges.
fn columns(splat: &Splat, camera: &Camera, row: u32) -> Range<i64> {
    if camera.mapping != Mapping::Equirectangular {
        let columns = covered(splat.at.x, widened(splat, camera), camera.width);
        return columns.start.into()..columns.end.into();
    }
    // Where the star and the row are nearest to a pole, the circle around the star is widest.
    let half_height = 0.5 * f64::from(camera.height);
    let nearest = splat.at.y.min(row.into()) - half_height;
    let farthest = splat.at.y.max(f64::from(row) + 1.0) - half_height;
    let latitude = camera.right.length() * nearest.abs().max(farthest.abs());
    let half = splat.reach / latitude.min(FRAC_PI_2).cos().max(1e-9);
    let width = i64::from(camera.width);
    if 2.0 * half + 1.0 >= f64::from(camera.width) {
        let first = splat.at.x.round() as i64 - width / 2;
        return first..first + width;
    }
    (splat.at.x - half).floor() as i64..(splat.at.x + half + 1.0).floor() as i64
}
