//! The rays of the chart, and the error of a method's answer.
//!
//! All methods are compared on one set of rays, those of the observer at infinity with b/b_c − 1 (b the impact
//! parameter, b_c its critical value) log-uniform from 1e-6 to 100. This observer has no picture, so the unit of
//! his image-space errors is a pixel of the picture 1920 × 1080 and 90° across seen from r = 10: it changes the
//! undeflected view angle by p = 2 tan(45°)/1920 rad, b by 10 p, and the sky angle by p (1 + 10 |dΔ/db|). Finite
//! observers look at the hole through that picture itself.

use crate::methods::{InitialConditions, MethodOutcome};
use crate::table_error::Picture;
use fastrand::Rng;
use lensbake_core::rk4::Stepper;
use lensbake_core::{B_CRIT, Observer, RayOutcome, ShadowCoordinate, direct, exact};
use lensbake_tables::baking::ObservedRay;
use std::f64::consts::FRAC_PI_2;

/// The picture whose pixels are the unit of image-space errors.
pub const PICTURE: Picture = Picture {
    width: 1920,
    field_of_view: FRAC_PI_2,
};
/// Width over height of [`PICTURE`].
const ASPECT: f64 = 16.0 / 9.0;
/// Radius of the observer whose pixels are used for the observer at infinity.
pub const FAR_PICTURE_RADIUS: f64 = 10.0;
/// Range of b/b_c − 1 of the rays of the observer at infinity.
pub const EXCESS: (f64, f64) = (1e-6, 100.0);

/// An observer of the chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChartObserver {
    /// The observer at infinity.
    Far,
    /// The static observer at this radius, looking at the hole.
    View(f64),
}

impl ChartObserver {
    /// All observers of the chart.
    pub const ALL: [ChartObserver; 5] = [
        ChartObserver::Far,
        ChartObserver::View(50.0),
        ChartObserver::View(25.0),
        ChartObserver::View(10.0),
        ChartObserver::View(5.0),
    ];

    /// This observer as an [`Observer`].
    pub fn observer(self) -> Observer {
        match self {
            ChartObserver::Far => Observer::at_infinity(),
            ChartObserver::View(r) => Observer::at(r).unwrap_or(Observer::at_infinity()),
        }
    }

    /// `count` random rays; the same `seed` gives the same rays.
    pub fn rays(self, count: usize, seed: u64) -> Vec<Ray> {
        let mut rng = Rng::with_seed(seed);
        (0..count)
            .map(|_| match self {
                ChartObserver::Far => far_ray(&mut rng),
                ChartObserver::View(_) => view_ray(self.observer(), &mut rng),
            })
            .collect()
    }
}

/// A ray, its true outcome, and the scales of its errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Initial conditions.
    pub initial: InitialConditions,
    /// Outcome in closed form, with the bending in rad.
    pub truth: RayOutcome,
    /// Change of the sky angle per pixel, rad.
    pub rad_per_pixel: f64,
    /// Distance from the shadow's edge, pixels.
    pub edge_px: f64,
}

/// The error of a method's answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Error {
    /// On the sky, rad; ∞ for a wrong outcome, for none, and for NaN.
    pub radians: f64,
    /// In image space, pixels. For a wrong outcome this is the ray's distance from the shadow's edge: the method
    /// has moved the edge at least that far.
    pub pixels: f64,
}

impl Ray {
    /// The error of `answer` for this ray.
    pub fn error(&self, answer: MethodOutcome) -> Error {
        match (self.truth, answer) {
            (RayOutcome::Escapes(truth), MethodOutcome::Escapes(bend)) if !bend.is_nan() => Error {
                radians: bend - truth,
                pixels: (bend - truth) / self.rad_per_pixel,
            },
            (RayOutcome::Captured, MethodOutcome::Captured) => Error {
                radians: 0.0,
                pixels: 0.0,
            },
            _ => Error {
                radians: f64::INFINITY,
                pixels: self.edge_px,
            },
        }
    }
}

/// The median error on the sky over the rays that escape both in truth and according to the answer, rad; NaN
/// without such rays.
pub fn median_on_sky<'a>(answers: impl IntoIterator<Item = (&'a Ray, MethodOutcome)>) -> f64 {
    let mut errors: Vec<f64> = answers
        .into_iter()
        .filter(|(ray, _)| ray.truth != RayOutcome::Captured)
        .map(|(ray, answer)| ray.error(answer).radians.abs())
        .filter(|error| error.is_finite())
        .collect();
    errors.sort_unstable_by(f64::total_cmp);
    errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN)
}

fn far_ray(rng: &mut Rng) -> Ray {
    let (first, last) = EXCESS;
    // Keep b strictly within the range of the naive axes.
    let excess = first * (last / first).powf(0.000_001 + 0.999_998 * rng.f64());
    let at = ShadowCoordinate {
        x: 1.0 / (1.0 + excess),
        one_minus_x: excess / (1.0 + excess),
    };
    let observer = Observer::at_infinity();
    let initial = InitialConditions::of(&ObservedRay { observer, at });
    let slope_in_b = slope(&observer, at) * at.x / initial.b;
    let pixel = PICTURE.pixel_angle();
    Ray {
        truth: truth(&initial),
        rad_per_pixel: pixel * (1.0 + FAR_PICTURE_RADIUS * slope_in_b),
        edge_px: B_CRIT * excess / (FAR_PICTURE_RADIUS * pixel),
        initial,
    }
}

fn view_ray(observer: Observer, rng: &mut Rng) -> Ray {
    let half = (0.5 * PICTURE.field_of_view).tan();
    let mut along = |half: f64| half * (2.0 * rng.f64() - 1.0);
    let theta = along(half).hypot(along(half / ASPECT)).atan();
    let at = observer.shadow_coordinate(theta);
    let initial = InitialConditions::of(&ObservedRay { observer, at });
    let pixel = PICTURE.pixel_angle();
    let sky_slope = 1.0 - slope(&observer, at) / observer.view_angle_slope(at.x);
    Ray {
        truth: truth(&initial),
        rad_per_pixel: pixel * sky_slope.abs(),
        edge_px: (theta - observer.shadow_angle()).abs() / pixel,
        initial,
    }
}

fn truth(initial: &InitialConditions) -> RayOutcome {
    initial
        .ray
        .map_or(RayOutcome::Captured, |ray| exact::bend(&ray))
}

/// dΔ/dx, rad; 0 for a captured ray.
fn slope(observer: &Observer, at: ShadowCoordinate) -> f64 {
    direct::bend_and_slope(observer, at, Stepper::Adaptive(1e-9))
        .escaped()
        .map_or(0.0, |bending| bending.slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::BendingMethod;
    use crate::methods::closed_form::ClosedForm;
    use crate::methods::far_model::FarModel;

    #[test]
    fn the_observer_put_at_infinity_is_off_by_degrees() {
        for (r, degrees) in [(50.0, 0.38), (25.0, 0.94), (10.0, 4.0), (5.0, 25.0)] {
            let rays = ChartObserver::View(r).rays(40_000, 1);
            let answers = rays.iter().map(|ray| (ray, FarModel.bend(&ray.initial)));
            let median = median_on_sky(answers).to_degrees();
            assert!((median / degrees - 1.0).abs() < 0.04, "r {r}: {median}");
        }
    }

    #[test]
    fn the_closed_form_has_no_error_and_the_sets_are_reproducible() {
        for observer in ChartObserver::ALL {
            let rays = observer.rays(200, 3);
            assert_eq!(rays, observer.rays(200, 3));
            for ray in &rays {
                assert_eq!(ray.error(ClosedForm.bend(&ray.initial)).radians, 0.0);
                assert!(ray.rad_per_pixel > 0.0);
            }
        }
    }

    #[test]
    fn a_wrong_outcome_is_an_error() {
        let ray = ChartObserver::Far.rays(1, 1)[0];
        for answer in [
            MethodOutcome::Captured,
            MethodOutcome::Unfinished,
            MethodOutcome::Escapes(f64::NAN),
        ] {
            assert_eq!(ray.error(answer).radians, f64::INFINITY);
            assert!(ray.error(answer).pixels > 0.0);
        }
    }
}
