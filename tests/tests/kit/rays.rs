//! The rays that every language is asked for, and the errors of its answers against the closed form.

use fastrand::Rng;
use glam::DVec3;
use lensbake_core::rk4::Stepper;
use lensbake_core::{Observer, RayOutcome, direct, exact};
use lensbake_tables::default_atlas;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Radii of the observers: the finite ones of the test vectors in docs/use.md, and some between them.
pub const RADII: [f64; 10] = [1000.0, 100.0, 25.0, 10.0, 3.0, 1.5, 1.2, 1.05, 1.01, 1.0001];
/// Rays for each of them.
const RAYS: usize = 10_000;
/// Angle that the middle pixel of a picture covers that is 1920 pixels wide and 90° across.
const PIXEL: f64 = 2.0 / 1920.0;

/// A ray as the texts take it, in single precision: view direction and direction of the hole, in an arbitrary frame.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Ray {
    /// Radius of the observer.
    pub r: f32,
    /// Unit view direction.
    pub d: [f32; 3],
    /// Unit direction of the hole.
    pub hole: [f32; 3],
    /// Index of the observer in [`RADII`].
    pub observer: f32,
}

/// A direction on the sky, or zeros.
pub type Answer = [f32; 3];

/// [`RAYS`] rays for each observer: half of them uniform in the view angle, half crowded at the shadow's edge, down to
/// 1 − x = 1e-6; a tenth of all inside the shadow.
pub fn rays(radii: &[f64]) -> Vec<Ray> {
    rays_of(radii, at_rest)
}

/// The observer at rest at this radius.
pub fn at_rest(r: f64) -> Observer {
    Observer::at(r).unwrap()
}

/// The observer in free fall at this radius.
pub fn in_fall(r: f64) -> Observer {
    Observer::falling(r).unwrap()
}

/// As [`rays`], for the observers that `motion` makes of the radii.
pub fn rays_of(radii: &[f64], motion: fn(f64) -> Observer) -> Vec<Ray> {
    let mut rng = Rng::with_seed(14);
    let mut rays = Vec::new();
    for (index, &radius) in radii.iter().enumerate() {
        let r = radius as f32;
        let observer = motion(r.into());
        let edge = observer.shadow_angle();
        for i in 0..RAYS {
            let theta = match i % 20 {
                0 | 1 => edge * rng.f64(),
                2..=10 => edge + (PI - edge) * rng.f64(),
                _ => observer.view_angle(1.0 - 10f64.powf(-6.0 * rng.f64())),
            };
            let hole = unit(&mut rng);
            let across = hole.cross(unit(&mut rng)).normalize();
            let d = hole * theta.cos() + across * theta.sin();
            let single = |v: DVec3| v.as_vec3().to_array();
            rays.push(Ray {
                r,
                d: single(d),
                hole: single(hole),
                observer: index as f32,
            });
        }
    }
    rays
}

fn unit(rng: &mut Rng) -> DVec3 {
    loop {
        let v = DVec3::from_array(std::array::from_fn(|_| 2.0 * rng.f64() - 1.0));
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// The rows of the observers of [`rays`], in single precision.
pub fn rows(radii: &[f64]) -> Vec<[f32; 2]> {
    let row = |&radius: &f64| {
        let observer = Observer::at((radius as f32).into()).unwrap();
        default_atlas().row(observer).unwrap().gpu_texels()
    };
    radii.iter().flat_map(row).collect()
}

/// The largest errors of the answers of one text.
#[derive(Debug, Clone, Copy, Default)]
pub struct Errors {
    /// Rays.
    pub rays: usize,
    /// In image space, pixels. A ray with the wrong outcome counts by its distance from the shadow's edge.
    pub pixels: f64,
    /// On the sky, rad.
    pub radians: f64,
    /// On the sky, rad, of rays at least 0.01 from the shadow's edge in x.
    pub radians_off_edge: f64,
    /// Rays with the wrong outcome.
    pub wrong: usize,
    /// Of the lengths of the directions, which should be 1.
    pub length: f64,
}

impl Errors {
    fn and(self, other: Errors) -> Errors {
        Errors {
            rays: self.rays + other.rays,
            pixels: self.pixels.max(other.pixels),
            radians: self.radians.max(other.radians),
            radians_off_edge: self.radians_off_edge.max(other.radians_off_edge),
            wrong: self.wrong + other.wrong,
            length: self.length.max(other.length),
        }
    }

    /// The errors of `answers` to `rays`.
    ///
    /// # Panics
    /// If there are not as many answers as rays.
    pub fn of(rays: &[Ray], answers: &[Answer]) -> Errors {
        Errors::of_moving(rays, answers, at_rest)
    }

    /// The errors of `answers` to `rays` of the observers that `motion` makes of their radii.
    ///
    /// # Panics
    /// If there are not as many answers as rays.
    pub fn of_moving(rays: &[Ray], answers: &[Answer], motion: fn(f64) -> Observer) -> Errors {
        assert_eq!(rays.len(), answers.len());
        let pairs = rays.par_iter().zip(answers);
        pairs
            .map(|(ray, answer)| error(ray, *answer, &motion(ray.r.into())))
            .reduce(Errors::default, Errors::and)
    }
}

fn error(ray: &Ray, answer: Answer, observer: &Observer) -> Errors {
    let [d, hole] = [ray.d, ray.hole].map(|v| DVec3::from(v.map(f64::from)).normalize());
    let theta = d.cross(hole).length().atan2(d.dot(hole));
    let at = observer.shadow_coordinate(theta);
    let answer = DVec3::from(answer.map(f64::from));
    assert!(answer.is_finite(), "{ray:?}: {answer}");
    let seen = (answer != DVec3::ZERO).then_some(answer);
    let one = Errors {
        rays: 1,
        ..Errors::default()
    };
    // The bending at rest (at the horizon and below, the orbital angle), and the difference of the two view angles.
    let frame = observer.in_row_frame();
    let bend = exact::bend(&frame.ray_at(at));
    let bend = bend.map(|bend| bend + observer.view_angle(at.x) - frame.view_angle(at.x));
    match (bend, seen) {
        (RayOutcome::Captured, None) => one,
        (RayOutcome::Escapes(bend), Some(seen)) => {
            let across = (d - hole * d.dot(hole)).normalize_or_zero();
            let truth = hole * (theta - bend).cos() + across * (theta - bend).sin();
            let radians = 2.0 * (0.5 * seen.normalize().distance(truth)).asin();
            let slope = direct::bend_and_slope(&frame, at, Stepper::Adaptive(1e-8));
            let by_x = frame.view_angle_slope(at.x) - slope.escaped().unwrap().slope;
            let sky_slope = by_x / observer.view_angle_slope(at.x);
            Errors {
                radians,
                radians_off_edge: if at.one_minus_x < 0.01 { 0.0 } else { radians },
                pixels: radians / (sky_slope.abs() * PIXEL),
                length: (seen.length() - 1.0).abs(),
                ..one
            }
        }
        _ => Errors {
            pixels: (theta - observer.shadow_angle()).abs() / PIXEL,
            wrong: 1,
            ..one
        },
    }
}
