//! Test rays that measure the error of a table.

use crate::{Axis, Header, Rows};
use fastrand::Rng;
use lensbake_core::{Observer, ShadowCoordinate};
use std::f64::consts::FRAC_PI_2;

/// An observer and a view direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObservedRay {
    /// The observer.
    pub observer: Observer,
    /// Normalised shadow coordinate of the view direction.
    pub at: ShadowCoordinate,
}

impl AsRef<ObservedRay> for ObservedRay {
    fn as_ref(&self) -> &ObservedRay {
        self
    }
}

/// Smallest radius of the observers of random rays.
pub const R_MIN: f64 = 1.005;
/// Smallest 1 − x of test rays: how close to the shadow boundary they come.
pub const EDGE_GAP: f64 = 1e-6;

/// `count` random rays for `table`, the same for the same seed. Radii are uniform in χ from infinity to [`R_MIN`],
/// or the radius is the table's own.
///
/// On the residual axis, half of the directions are uniform in the view angle (in x for the observer at infinity)
/// from the shadow boundary to straight away from the hole. The other half are concentrated near the shadow
/// boundary: uniform in log(1 − x), down to 1 − x = [`EDGE_GAP`]. On an axis in b, half are uniform along the axis
/// and half uniform in log(b − b_c).
pub fn random(table: &Header, count: usize, seed: u64) -> Vec<ObservedRay> {
    let mut rng = Rng::with_seed(seed);
    (0..count).map(|_| random_ray(table, &mut rng)).collect()
}

fn random_ray(table: &Header, rng: &mut Rng) -> ObservedRay {
    let observer = match table.rows {
        Rows::One { .. } => table.observer(0),
        Rows::Chi { .. } | Rows::ThroughHorizon { .. } => {
            let chi_max = (1.0 / R_MIN).sqrt().asin();
            Observer::at_chi(rng.f64() * chi_max)
        }
    };
    random_direction(table.axis, observer, rng)
}

/// A random ray of `observer`, with the directions that [`random`] says.
pub(super) fn random_direction(axis: Axis, observer: Observer, rng: &mut Rng) -> ObservedRay {
    let crowd = rng.bool();
    let t = rng.f64();
    let at = match axis {
        Axis::Residual if crowd => edge_gap(EDGE_GAP.powf(t)),
        Axis::Residual if observer.is_at_infinity() => edge_gap(EDGE_GAP + t * (1.0 - EDGE_GAP)),
        Axis::Residual => away_from_edge(&observer, t),
        axis => in_b(axis, t, crowd),
    };
    ObservedRay { observer, at }
}

pub(super) fn edge_gap(one_minus_x: f64) -> ShadowCoordinate {
    ShadowCoordinate {
        x: 1.0 - one_minus_x,
        one_minus_x,
    }
}

/// The direction at the fraction `t` of the view angles from the shadow boundary to straight away from the hole,
/// but at least [`EDGE_GAP`] from the shadow boundary.
fn away_from_edge(observer: &Observer, t: f64) -> ShadowCoordinate {
    let edge = observer.shadow_angle();
    off_edge(observer.shadow_coordinate(edge + t * (std::f64::consts::PI - edge)))
}

/// The direction `at`, but at least [`EDGE_GAP`] from the shadow boundary.
pub(super) fn off_edge(at: ShadowCoordinate) -> ShadowCoordinate {
    if at.one_minus_x < EDGE_GAP {
        edge_gap(EDGE_GAP)
    } else {
        at
    }
}

fn in_b(axis: Axis, t: f64, crowd: bool) -> ShadowCoordinate {
    match axis.b_range() {
        Some((b_min, b_max)) if crowd => Axis::UniformLogB { b_min, b_max }.coordinate(t),
        _ => axis.coordinate(t),
    }
}

/// Rays between the nodes of a table, dense enough to find its largest error. Observers lie between all rows, down
/// to the last gap before the horizon. Each observer has four rays per texel, and rays near the shadow boundary at
/// powers of ten of 1 − x down to [`EDGE_GAP`].
pub fn off_nodes(table: &Header) -> Vec<ObservedRay> {
    let cells = 4 * (table.texels - 1);
    let along: Vec<f64> = (0..cells)
        .map(|i| (f64::from(i) + 0.5) / f64::from(cells))
        .collect();
    let near_edge = [1e-2, 1e-3, 1e-4, 1e-5, EDGE_GAP].map(edge_gap);
    let near_edge = match table.axis {
        Axis::Residual => &near_edge[..],
        _ => &[],
    };
    let rays_of = |observer: Observer| {
        along
            .iter()
            .map(move |&q| table.axis.of(&observer).shadow_coordinate(&observer, q))
            .filter(|at| at.one_minus_x >= EDGE_GAP)
            .chain(near_edge.iter().copied())
            .map(move |at| ObservedRay { observer, at })
    };
    observers_off_nodes(table)
        .into_iter()
        .flat_map(rays_of)
        .collect()
}

fn observers_off_nodes(table: &Header) -> Vec<Observer> {
    let off_nodes = |rows: u32| {
        let count = 3 * (rows - 1);
        (0..count).map(move |i| (f64::from(i) + 0.5) / f64::from(count))
    };
    let above = off_nodes(table.rows_above()).map(|t| Observer::at_chi(t * FRAC_PI_2));
    match table.rows {
        Rows::One { .. } => vec![table.observer(0)],
        Rows::Chi { .. } => above.collect(),
        Rows::ThroughHorizon { below, r_min, .. } => {
            let inside = off_nodes(below)
                .filter_map(|t| Observer::falling(r_min.powf(t)).ok())
                .map(|observer| observer.in_row_frame());
            above.chain(inside).collect()
        }
    }
}
