//! The rays of the chart, and how an answer is judged.
//!
//! One set serves all methods: the observer at infinity, b/b_c − 1 by decades from 1e-6 to 100. He has
//! no picture, so his pixels are those that a picture 1920 × 1080 and 90° across has from r = 10: a pixel
//! turns the undeflected view by p = 2 tan(45°)/1920 rad and b by 10 p, and the sky by
//! p (1 + 10 |dΔ/db|). Finite observers look at the hole through that picture itself.

use crate::diff::Picture;
use crate::methods::{Launch, Outcome};
use crate::rays::Sight;
use fastrand::Rng;
use lensbake_core::rk4::Stepper;
use lensbake_core::{B_CRIT, EdgeCoordinate, Fate, Observer, direct, exact};
use std::f64::consts::FRAC_PI_2;

/// The picture in whose pixels errors are stated.
pub const PICTURE: Picture = Picture {
    width: 1920,
    field_of_view: FRAC_PI_2,
};
/// Its width over its height.
const ASPECT: f64 = 16.0 / 9.0;
/// The radius whose picture the far observer's pixels are taken from.
pub const FAR_PICTURE_RADIUS: f64 = 10.0;
/// Decades of b/b_c − 1 of the far observer's rays.
pub const EXCESS: (f64, f64) = (1e-6, 100.0);

/// Whose rays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Watcher {
    /// The observer at infinity.
    Far,
    /// The static observer at this radius, looking at the hole.
    View(f64),
}

impl Watcher {
    /// All observers of the chart.
    pub const ALL: [Watcher; 5] = [
        Watcher::Far,
        Watcher::View(50.0),
        Watcher::View(25.0),
        Watcher::View(10.0),
        Watcher::View(5.0),
    ];

    /// The observer himself.
    pub fn observer(self) -> Observer {
        match self {
            Watcher::Far => Observer::far(),
            Watcher::View(r) => Observer::at(r).unwrap_or(Observer::far()),
        }
    }

    /// `count` rays, the same for the same seed.
    pub fn rays(self, count: usize, seed: u64) -> Vec<Ray> {
        let mut rng = Rng::with_seed(seed);
        (0..count)
            .map(|_| match self {
                Watcher::Far => far_ray(&mut rng),
                Watcher::View(_) => view_ray(self.observer(), &mut rng),
            })
            .collect()
    }
}

/// A ray, its true fate, and the measures for an error of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Its launch.
    pub launch: Launch,
    /// The bending in closed form, rad.
    pub truth: Fate,
    /// How far the sky turns a pixel, rad.
    pub rad_a_pixel: f64,
    /// Pixels from the shadow's edge.
    pub edge_px: f64,
}

/// An answer's error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Error {
    /// On the sky, rad: ∞ for a wrong fate or none.
    pub radians: f64,
    /// In image space, pixels. A wrong fate counts by its distance from the edge, for that far at least
    /// the edge has moved.
    pub pixels: f64,
}

impl Ray {
    /// The error of an answer.
    pub fn error(&self, answer: Outcome) -> Error {
        match (self.truth, answer) {
            (Fate::Escapes(truth), Outcome::Escapes(bend)) if !bend.is_nan() => Error {
                radians: bend - truth,
                pixels: (bend - truth) / self.rad_a_pixel,
            },
            (Fate::Captured, Outcome::Captured) => Error {
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

/// The median error on the sky over the rays that both the truth and the answer let escape, rad; NaN
/// for none.
pub fn median_on_sky<'a>(answers: impl IntoIterator<Item = (&'a Ray, Outcome)>) -> f64 {
    let mut errors: Vec<f64> = answers
        .into_iter()
        .filter(|(ray, _)| ray.truth != Fate::Captured)
        .map(|(ray, answer)| ray.error(answer).radians.abs())
        .filter(|error| error.is_finite())
        .collect();
    errors.sort_unstable_by(f64::total_cmp);
    errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN)
}

fn far_ray(rng: &mut Rng) -> Ray {
    let (first, last) = EXCESS;
    // Strictly within the range of the naive axes.
    let excess = first * (last / first).powf(0.000_001 + 0.999_998 * rng.f64());
    let at = EdgeCoordinate {
        x: 1.0 / (1.0 + excess),
        one_minus_x: excess / (1.0 + excess),
    };
    let observer = Observer::far();
    let launch = Launch::of(&Sight { observer, at });
    let slope_in_b = slope(&observer, at) * at.x / launch.b;
    let pixel = PICTURE.pixel_angle();
    Ray {
        truth: truth(&launch),
        rad_a_pixel: pixel * (1.0 + FAR_PICTURE_RADIUS * slope_in_b),
        edge_px: B_CRIT * excess / (FAR_PICTURE_RADIUS * pixel),
        launch,
    }
}

fn view_ray(observer: Observer, rng: &mut Rng) -> Ray {
    let half = (0.5 * PICTURE.field_of_view).tan();
    let mut along = |half: f64| half * (2.0 * rng.f64() - 1.0);
    let theta = along(half).hypot(along(half / ASPECT)).atan();
    let at = observer.edge_coordinate(theta);
    let launch = Launch::of(&Sight { observer, at });
    let pixel = PICTURE.pixel_angle();
    let stretch = 1.0 - slope(&observer, at) / observer.view_angle_slope(at.x);
    Ray {
        truth: truth(&launch),
        rad_a_pixel: pixel * stretch.abs(),
        edge_px: (theta - observer.edge_angle()).abs() / pixel,
        launch,
    }
}

fn truth(launch: &Launch) -> Fate {
    launch.ray.map_or(Fate::Captured, |ray| exact::bend(&ray))
}

/// dΔ/dx, rad; 0 for a captured ray.
fn slope(observer: &Observer, at: EdgeCoordinate) -> f64 {
    direct::bend_and_slope(observer, at, Stepper::Adaptive(1e-9))
        .escaped()
        .map_or(0.0, |bending| bending.slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::Method;
    use crate::methods::closed_form::ClosedForm;
    use crate::methods::far_model::FarModel;

    #[test]
    fn the_observer_put_at_infinity_is_off_by_degrees() {
        for (r, degrees) in [(50.0, 0.38), (25.0, 0.94), (10.0, 4.0), (5.0, 25.0)] {
            let rays = Watcher::View(r).rays(40_000, 1);
            let answers = rays.iter().map(|ray| (ray, FarModel.bend(&ray.launch)));
            let median = median_on_sky(answers).to_degrees();
            assert!((median / degrees - 1.0).abs() < 0.04, "r {r}: {median}");
        }
    }

    #[test]
    fn the_closed_form_has_no_error_and_the_sets_are_reproducible() {
        for watcher in Watcher::ALL {
            let rays = watcher.rays(200, 3);
            assert_eq!(rays, watcher.rays(200, 3));
            for ray in &rays {
                assert_eq!(ray.error(ClosedForm.bend(&ray.launch)).radians, 0.0);
                assert!(ray.rad_a_pixel > 0.0);
            }
        }
    }

    #[test]
    fn a_wrong_fate_is_an_error() {
        let ray = Watcher::Far.rays(1, 1)[0];
        for answer in [
            Outcome::Captured,
            Outcome::Unfinished,
            Outcome::Escapes(f64::NAN),
        ] {
            assert_eq!(ray.error(answer).radians, f64::INFINITY);
            assert!(ray.error(answer).pixels > 0.0);
        }
    }
}
