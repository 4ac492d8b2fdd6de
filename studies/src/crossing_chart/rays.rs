//! The crossings of the chart, and the scales of their errors.
//!
//! Rays of observers at rest meet a disc from r = 3 to 12. Half of the view directions are uniform over the part of the sky
//! where the disc can be, half crowd the shadow's edge: their distance from it is log-uniform from 1e-6 of its radius, on
//! either side. The inclination is random (cos i uniform) and so is the azimuth.
//!
//! An error of the radius moves the image. In pixels it is the error over the change of the radius per pixel, |∇r| p: p is
//! the angle of a pixel in the middle of [`PICTURE`], and ∇r the gradient of the radius over the view direction. It falls
//! with the distance of the crossing from the observer, which is at least [`NEAREST`].

use crate::method_chart::rays::PICTURE;
use fastrand::Rng;
use lensbake_core::disc_crossing::{Crossing, TracedRay};
use lensbake_core::rk4;
use lensbake_core::{Observer, ThinDisc, orbit};
use std::f64::consts::{PI, TAU};

/// Radii of the observers.
pub const OBSERVERS: [f64; 4] = [4.0, 10.0, 25.0, 100.0];
/// Inner and outer radius of the disc.
pub const DISC: [f64; 2] = [3.0, 12.0];
/// Least distance of a crossing from the observer, in coordinates. An observer in the disc would see it from no distance,
/// where any error of the radius fills the picture.
pub const NEAREST: f64 = 0.1;

/// Steps of the integration that gives the truth.
const TRUE_STEPS: u32 = 1024;
/// Outer radius of the disc that the gradient is taken on, so that it does not end there.
const FAR: f64 = 1e6;

/// A crossing, and what its error is measured by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// 1/b and the phase, which f32 can represent.
    pub question: [f32; 2],
    /// The true inverse radius there, by RK4 in f64.
    pub truth: f64,
    /// How far it is from that at the same ray's 1/b and phase before they were rounded to f32.
    pub rounding: f64,
    /// Pixels in image space per unit of the inverse radius.
    pub pixels: f64,
}

/// The error of an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Error {
    /// Relative error of the radius.
    pub relative: f64,
    /// In image space, pixels.
    pub pixels: f64,
}

impl Sample {
    /// The error of the inverse radius `u`.
    pub fn error(&self, u: f64) -> Error {
        self.error_of(u - self.truth)
    }

    /// What rounding the question to f32 does.
    pub fn rounding_error(&self) -> Error {
        self.error_of(self.rounding)
    }

    fn error_of(&self, off: f64) -> Error {
        Error {
            relative: off / self.truth,
            pixels: off * self.pixels,
        }
    }
}

/// `count` crossings as the observer at rest at `radius` sees them; the same `seed` gives the same ones.
pub fn samples(radius: f64, count: usize, seed: u64) -> Vec<Sample> {
    let Ok(observer) = Observer::at(radius) else {
        return Vec::new();
    };
    let mut rng = Rng::with_seed(seed);
    let mut found = Vec::with_capacity(count);
    while found.len() < count {
        let sight = Sight::random(&observer, &mut rng);
        found.extend(sight.samples());
    }
    found.truncate(count);
    found
}

/// A view direction, and the inclination of the disc.
#[derive(Debug, Clone, Copy)]
struct Sight<'a> {
    observer: &'a Observer,
    theta: f64,
    azimuth: f64,
    inclination_deg: f64,
}

impl<'a> Sight<'a> {
    fn random(observer: &'a Observer, rng: &mut Rng) -> Self {
        let edge = observer.shadow_angle();
        let theta = if rng.bool() {
            // Beyond this impact parameter no ray from outside meets the disc.
            let sin = 1.1 * DISC[1] * observer.lapse() * observer.inverse_radius();
            let least = if sin < 1.0 {
                (1.0 - sin * sin).sqrt()
            } else {
                -1.0
            };
            (1.0 - (1.0 - least) * rng.f64()).acos()
        } else {
            let sign = if rng.bool() { 1.0 } else { -1.0 };
            edge * (1.0 + sign * 10f64.powf(-6.0 * rng.f64()))
        };
        Sight {
            observer,
            theta: theta.min(PI),
            azimuth: TAU * rng.f64(),
            inclination_deg: rng.f64().acos().to_degrees(),
        }
    }

    fn disc(&self, outer: f64) -> Option<ThinDisc> {
        ThinDisc::new(DISC[0], outer, self.inclination_deg, 0.0).ok()
    }

    /// The crossings with the disc out to `outer`, and 1/b.
    fn crossings(&self, outer: f64) -> (Vec<Crossing>, f64) {
        let Some(disc) = self.disc(outer) else {
            return (Vec::new(), f64::NAN);
        };
        let at = self.observer.shadow_coordinate(self.theta);
        let ray = TracedRay::in_closed_form(&disc, self.observer, at, self.azimuth);
        (disc.crossings(&ray).collect(), ray.inv_b)
    }

    fn samples(&self) -> Vec<Sample> {
        let (crossings, inv_b) = self.crossings(DISC[1]);
        let sample = |crossing: &Crossing| self.sample(crossing, inv_b);
        crossings.iter().filter_map(sample).collect()
    }

    /// `None` within a step of the disc's inner edge, where there is no gradient, and within [`NEAREST`].
    fn sample(&self, crossing: &Crossing, inv_b: f64) -> Option<Sample> {
        if self.distance(crossing) < NEAREST {
            return None;
        }
        let u = 1.0 / crossing.radius;
        let phase = orbit::phase(inv_b, u)?;
        let question = [inv_b as f32, phase as f32];
        let truth = integrated(question.map(f64::from));
        let per_pixel = self.gradient(crossing.order)? * PICTURE.pixel_angle();
        Some(Sample {
            question,
            truth,
            rounding: truth - u,
            pixels: 1.0 / (u * u * per_pixel),
        })
    }

    /// Distance of the observer from a crossing, as if space were flat.
    fn distance(&self, crossing: &Crossing) -> f64 {
        let (r, at) = (self.observer.radius(), crossing.radius);
        (r * r + at * at - 2.0 * r * at * crossing.phi.cos()).sqrt()
    }

    /// |∇r| over the view direction of the image of `order`, per rad, by differences in a thousandth of the distance from
    /// the shadow's edge.
    fn gradient(&self, order: u32) -> Option<f64> {
        let from_edge = (self.theta - self.observer.shadow_angle()).abs();
        let h = (1e-3 * from_edge).min(1e-5 * self.theta.sin());
        let difference = |step: fn(Self, f64) -> Self, h: f64| {
            let radius = |h| step(*self, h).radius(order);
            Some((radius(h)? - radius(-h)?) / (2.0 * h))
        };
        let along = difference(
            |sight, h| Sight {
                theta: sight.theta + h,
                ..sight
            },
            h,
        )?;
        let turned = |sight: Self, h| Sight {
            azimuth: sight.azimuth + h,
            ..sight
        };
        let across = difference(turned, 1e-5)? / self.theta.sin();
        Some(along.hypot(across)).filter(|gradient| *gradient > 0.0)
    }

    fn radius(&self, order: u32) -> Option<f64> {
        let (crossings, _) = self.crossings(FAR);
        let image = crossings.iter().find(|crossing| crossing.order == order);
        image.map(|crossing| crossing.radius)
    }
}

/// u at the phase of the ray with 1/b, by RK4.
fn integrated([inv_b, phase]: [f64; 2]) -> f64 {
    let binet = |y: &[f64; 2]| [y[1], 1.5 * y[0] * y[0] - y[0]];
    let mut y = [0.0, inv_b];
    for _ in 0..TRUE_STEPS {
        y = rk4::step(&binet, &y, phase / f64::from(TRUE_STEPS));
    }
    y[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_samples_are_crossings_of_the_disc_and_the_truth_is_that_of_the_closed_form() {
        for radius in OBSERVERS {
            let samples = samples(radius, 300, 3);
            assert_eq!(samples.len(), 300);
            for sample in samples {
                let [inv_b, phase] = sample.question.map(f64::from);
                let u = orbit::inverse_radius(inv_b, phase);
                assert!((u / sample.truth - 1.0).abs() < 1e-11, "{sample:?}");
                assert!(
                    (1.0 / 12.0 - 1e-5..1.0 / 3.0 + 1e-5).contains(&u),
                    "{sample:?}"
                );
                assert!(sample.pixels > 0.0 && sample.pixels.is_finite());
                assert!(sample.rounding.abs() < 1e-5 * u, "{sample:?}");
            }
        }
    }

    /// From far away, face-on, the radius of a distant ring grows by r per unit of its angle.
    #[test]
    fn the_gradient_of_a_face_on_disc_far_away_is_the_distance() {
        let observer = Observer::at(1e5).unwrap();
        let sight = Sight {
            observer: &observer,
            theta: 1e-2,
            azimuth: 0.3,
            inclination_deg: 0.0,
        };
        let gradient = sight.gradient(0).unwrap();
        assert!((gradient / 1e5 - 1.0).abs() < 2e-3, "{gradient}");
    }
}
