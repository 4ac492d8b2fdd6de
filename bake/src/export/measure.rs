//! The error of the numbers of an exported text, against the closed form.

use super::numbers::Numbers;
use lensbake_core::rk4::Stepper;
use lensbake_core::{Observer, ShadowCoordinate, direct, exact};
use lensbake_tables::baking::{ObservedRay, random};
use lensbake_tables::{Axis, Table};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// Random rays that are measured.
pub const RAYS: usize = 20_000;
/// Tolerance of the integration that finds the size of a pixel on the sky.
const TOLERANCE: f64 = 1e-8;
/// Width of the picture whose pixels are the unit of errors in image space; it is 90° across.
pub const WIDTH: f64 = 1920.0;

/// The largest errors of a lookup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// On the sky, rad.
    pub radians: f64,
    /// In image space: the error on the sky over the angle that the middle pixel of a picture covers there.
    pub pixels: f64,
}

/// The errors of `bend`, the bending of a ray in rad, over [`RAYS`] random rays of the observers of `table`.
pub fn errors(table: &Table, bend: impl Fn(&ObservedRay) -> f64 + Sync) -> Errors {
    let pixel = 2.0 / WIDTH;
    let rays = random(table.header(), RAYS, 1);
    let errors = rays.par_iter().filter_map(|ray| {
        let ObservedRay { observer, at } = ray;
        let closed = exact::bend(&observer.ray_at(*at)).escaped()?;
        let slope = direct::bend_and_slope(observer, *at, Stepper::Adaptive(TOLERANCE))
            .escaped()?
            .slope;
        let error = (bend(ray) - closed).abs();
        let sky_slope = 1.0 - slope / observer.view_angle_slope(at.x);
        let pixels = if observer.is_at_infinity() {
            0.0
        } else {
            error / (sky_slope.abs() * pixel)
        };
        Some([error, pixels])
    });
    let [radians, pixels] = errors.reduce(|| [0.0; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    Errors { radians, pixels }
}

/// The errors of looking up rows of `table`, in which the texels are rounded already.
pub fn rows(table: &Table) -> Errors {
    errors(table, |ray| match table.row(ray.observer) {
        Ok(row) => row.bend(ray.at).escaped().unwrap_or(f64::INFINITY),
        Err(_) => f64::INFINITY,
    })
}

/// The errors of one fetch with linear filtering from all rows above the horizon of `table`, with the 8-bit weights that
/// the filters of GPUs have.
pub fn filtered(table: &Table, numbers: &Numbers) -> Errors {
    let (texels, rows) = (table.header().texels, table.header().row_count());
    errors(table, |ray| {
        filtered_bend(&ray.observer, ray.at, numbers, [texels, rows])
    })
}

fn filtered_bend(
    observer: &Observer,
    at: ShadowCoordinate,
    numbers: &Numbers,
    size: [u32; 2],
) -> f64 {
    let axis = Axis::Residual;
    let place = [axis.position(at), observer.chi() / FRAC_PI_2];
    let [(x, tx), (y, ty)] = [0, 1].map(|i| {
        let position = place[i] * f64::from(size[i] - 1);
        let first = position.floor().min(f64::from(size[i] - 2));
        (first as usize, ((position - first) * 256.0).round() / 256.0)
    });
    let value = |x: usize, y: usize| f64::from(numbers.texels[y * size[0] as usize + x][0]);
    let line = |y: usize| value(x, y) + tx * (value(x + 1, y) - value(x, y));
    let stored = line(y) + ty * (line(y + 1) - line(y));
    axis.bend(observer, at, stored)
}
