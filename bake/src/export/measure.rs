//! The error of the numbers of an exported text, against the closed form.

use super::numbers::Numbers;
use fastrand::Rng;
use lensbake_core::rk4::Stepper;
use lensbake_core::{Observer, ShadowCoordinate, direct, exact};
use lensbake_studies::methods::filter_weight::{bilinear, texel_and_weight};
use lensbake_tables::baking::{EDGE_GAP, ObservedRay, random};
use lensbake_tables::interpolation::cubic;
use lensbake_tables::lookup::HorizonSide;
use lensbake_tables::{Axis, Table, Texel};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

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

/// A ray of an observer in the frame of the table's rows, and the same observer in the frame that the text is for.
struct FrameRay {
    ray: ObservedRay,
    own: Observer,
}

/// The largest errors of `bend`, the bending of a ray in the observer's own frame in rad.
fn errors(rays: &[FrameRay], bend: impl Fn(&FrameRay) -> f64 + Sync) -> Errors {
    let pixel = 2.0 / WIDTH;
    let errors = rays.par_iter().filter_map(|frame_ray| {
        let (own, ObservedRay { observer, at }) = (&frame_ray.own, &frame_ray.ray);
        let aberration = own.view_angle(at.x) - observer.view_angle(at.x);
        let closed = exact::bend(&observer.ray_at(*at)).escaped()? + aberration;
        let error = (bend(frame_ray) - closed).abs();
        let direct = direct::bend_and_slope(observer, *at, Stepper::Adaptive(TOLERANCE));
        let by_x = observer.view_angle_slope(at.x) - direct.escaped()?.slope;
        let sky_slope = by_x / own.view_angle_slope(at.x);
        let pixels = match observer.is_at_infinity() {
            true => 0.0,
            false => error / (sky_slope.abs() * pixel),
        };
        Some([error, pixels])
    });
    let [radians, pixels] = errors.reduce(|| [0.0; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    Errors { radians, pixels }
}

/// Rays of all observers at rest.
fn rays_of_all(table: &Table) -> Vec<FrameRay> {
    let rays = random(table.header(), RAYS, 1).into_iter();
    rays.map(|ray| FrameRay {
        ray,
        own: ray.observer,
    })
    .collect()
}

/// Rays of `own`: half of them uniform in the view angle, half crowded at the edge of the shadow.
fn rays_of_one(own: Observer) -> Vec<FrameRay> {
    let mut rng = Rng::with_seed(1);
    let edge = own.shadow_angle();
    let mut ray = || {
        let gap = EDGE_GAP.powf(rng.f64());
        let theta = edge + (PI - edge) * rng.f64();
        let at = match rng.bool() {
            true => ShadowCoordinate {
                x: 1.0 - gap,
                one_minus_x: gap,
            },
            false => own.shadow_coordinate(theta),
        };
        let observer = own.in_row_frame();
        FrameRay {
            ray: ObservedRay { observer, at },
            own,
        }
    };
    let rays = (0..RAYS).map(|_| ray());
    rays.filter(|ray| ray.ray.at.one_minus_x >= EDGE_GAP)
        .collect()
}

/// The errors of looking up rows of `table`, in which the texels are rounded already.
pub fn rows(table: &Table) -> Errors {
    errors(&rays_of_all(table), |FrameRay { ray, .. }| {
        match table.row(ray.observer) {
            Ok(row) => row.bend(ray.at).escaped().unwrap_or(f64::INFINITY),
            Err(_) => f64::INFINITY,
        }
    })
}

/// The errors of looking up the row of one `observer`, with `texels` as a GPU holds them.
pub fn one_row(observer: Observer, texels: &[Texel]) -> Errors {
    let axis = Axis::Residual.of(&observer);
    let last = (texels.len() - 1) as f64;
    errors(&rays_of_one(observer), |FrameRay { ray, .. }| {
        let at = axis.row_coordinate(&observer, ray.at);
        let q = axis.position(at);
        let position = last
            * match HorizonSide::of(&observer) {
                HorizonSide::Above => q,
                HorizonSide::Below => 1.0 - q,
            };
        let i = (position as usize).min(texels.len() - 2);
        let [a, b] = [i, i + 1].map(|i| texels[i].map(f64::from));
        let [value, _] = cubic(a, b, position - i as f64);
        axis.bend(&observer, at, value)
    })
}

/// The errors of one fetch with linear filtering from all rows above the horizon of `table`, with the 8-bit weights that
/// the filters of GPUs have.
pub fn filtered(table: &Table, numbers: &Numbers) -> Errors {
    let (texels, rows) = (table.header().texels, table.header().row_count());
    errors(&rays_of_all(table), |FrameRay { ray, .. }| {
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
    let [x, y] = [0, 1].map(|i| {
        let position = place[i] * f64::from(size[i] - 1);
        texel_and_weight(position, size[i] as usize)
    });
    let value = |x: usize, y: usize| f64::from(numbers.texels[y * size[0] as usize + x][0]);
    let stored = bilinear(value, x, y);
    axis.bend(observer, at, stored)
}
