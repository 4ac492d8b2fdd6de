//! Discs around the hole: the radii that are drawn against the closed form, pictures of the GPU against those of the CPU,
//! and a flight through the plane of the disc.

use glam::{DVec2, Vec3};
use lensbake_core::disc_crossing::TracedRay;
use lensbake_core::{Motion, MovingFrame, ThinDisc};
use lensbake_render::camera::{Camera, View};
use lensbake_render::cpu;
use lensbake_render::disc::{Disc, SeenDisc};
use lensbake_render::footprint::Patch;
use lensbake_render::gpu::Pass;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::Rendition;
use lensbake_render::sky::{self, Sky, SkySource};
use lensbake_tests::{lens, on_gpu, renderer};
use std::sync::Arc;

fn inclined(inclination_deg: f64) -> Disc {
    let mut disc = Disc::default();
    disc.orientation.inclination_deg = inclination_deg;
    disc
}

fn grid() -> Arc<Sky> {
    Arc::new(sky::load(&SkySource::Grid).unwrap())
}

/// The crossings of the ray at `at` (pixels from the middle of the picture) in closed form: (radius, image order).
fn known(disc: &Disc, frame: &MovingFrame, camera: &Camera, at: DVec2) -> Vec<(f64, u32)> {
    let thin = ThinDisc::new(
        disc.inner,
        disc.outer,
        disc.orientation.inclination_deg,
        0.0,
    );
    let thin = thin.unwrap();
    let seen = camera.ray(at).normalize();
    let theta = seen.x.hypot(seen.y).atan2(-seen.z);
    let at = frame.observer().shadow_coordinate(theta);
    let ray = TracedRay::in_closed_form(&thin, frame.observer(), at, seen.y.atan2(seen.x));
    let crossings = thin.crossings(&ray);
    crossings
        .map(|crossing| (crossing.radius, crossing.order))
        .collect()
}

/// The radii that are drawn are those of the closed form, in image space: the error of the radius divided by how much it
/// changes from one pixel to the next.
#[test]
fn the_first_three_images_are_where_the_closed_form_says() {
    let mut worst = [0.0_f64; 3];
    let mut compared = [0; 3];
    for (radius, fov_deg) in [(4.0, 90.0), (10.0, 90.0), (25.0, 90.0), (100.0, 16.0)] {
        let view = View {
            radius,
            fov_deg,
            ..View::default()
        };
        let lens = lens(&view, Deflection::Lut);
        let camera = &lens.camera;
        let frame = MovingFrame::new(radius, Motion::Rest).unwrap();
        for inclination_deg in [0.0, 30.0, 60.0, 80.0, 89.0, 90.0] {
            let disc = inclined(inclination_deg);
            let seen = SeenDisc::new(&lens, disc, Rendition::default());
            let radius_at = |at: DVec2, order: u32| {
                let crossings = known(&disc, &frame, camera, at);
                crossings
                    .into_iter()
                    .find(|(_, of)| *of == order)
                    .map(|(radius, _)| radius)
            };
            // Beside the shadow's edge, where the second and the third images are, and over the whole picture.
            let edge = camera.observer.shadow_angle().tan() / camera.right.length();
            let near = (0..400).flat_map(|i| {
                let (sin, cos) = (f64::from(i) * 0.0157).sin_cos();
                [0.05, 0.2, 0.5, 1.0, 3.0, 10.0].map(|out| DVec2::new(cos, sin) * (edge + out))
            });
            let far = (0..4000)
                .map(|i| DVec2::new(f64::from(i % 80) - 39.6, f64::from(i / 80) - 24.7) * 21.3);
            for at in near.chain(far) {
                let direction = camera.ray(at).normalize();
                let patch = Patch::new(direction, glam::DVec3::ZERO, glam::DVec3::ZERO);
                for hit in seen
                    .hits(&patch)
                    .into_iter()
                    .flatten()
                    .filter(|hit| hit.order < 3)
                {
                    let step = 1e-3;
                    let change = [DVec2::X, DVec2::Y].map(|along| {
                        let ends = [1.0, -1.0]
                            .map(|sign| radius_at(at + along * (sign * step), hit.order));
                        Some((ends[0]? - ends[1]?) / (2.0 * step))
                    });
                    let ([Some(x), Some(y)], Some(known)) = (change, radius_at(at, hit.order))
                    else {
                        continue;
                    };
                    let order = hit.order as usize;
                    worst[order] = worst[order].max((hit.radius - known).abs() / x.hypot(y));
                    compared[order] += 1;
                }
            }
        }
    }
    println!("largest errors of the first three images, px: {worst:?}, of {compared:?} crossings");
    assert!(compared.iter().all(|&n| n > 1000), "{compared:?}");
    assert!(worst.iter().all(|&px| px < 0.01), "{worst:?}");
}

/// Number of pixels of which a channel differs by more than `levels` of 255.
fn different(one: &Picture, other: &Picture, levels: u8) -> usize {
    let (one, other) = (one.srgb(0.0), other.srgb(0.0));
    let differs = |(a, b): &(&[u8; 3], &[u8; 3])| (0..3).any(|i| a[i].abs_diff(b[i]) > levels);
    one.iter().zip(&other).filter(differs).count()
}

/// Views of discs: radius, motion, yaw, field of view, inclination, opacity.
const VIEWS: [(f64, Motion, f64, f64, f64, f64); 10] = [
    (25.0, Motion::Rest, 0.0, 90.0, 80.0, 1.0),
    (25.0, Motion::Rest, 0.0, 60.0, 90.0, 1.0),
    (25.0, Motion::Rest, 10.0, 60.0, 89.9, 0.5),
    (10.0, Motion::Rest, 0.0, 90.0, 0.0, 1.0),
    (20.0, Motion::Rest, 0.0, 90.0, 80.0, 1.0),
    (1.2, Motion::Fall, 0.0, 120.0, 80.0, 1.0),
    (0.5, Motion::Fall, 60.0, 100.0, 60.0, 1.0),
    (7.0, Motion::Orbit, 0.0, 100.0, 90.0, 1.0),
    (3.5, Motion::Orbit, 0.0, 100.0, 88.0, 0.7),
    (100.0, Motion::Fall, 0.0, 20.0, 30.0, 1.0),
];

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_the_picture_of_the_cpu() {
    let (renderer, grid) = (renderer(), grid());
    let mut worse = Vec::new();
    for (radius, motion, yaw_deg, fov_deg, inclination_deg, opacity) in VIEWS {
        let view = View {
            radius,
            motion,
            yaw_deg,
            fov_deg,
            width: 480,
            height: 270,
            ..View::default()
        };
        let smooth = Disc {
            opacity,
            ..inclined(inclination_deg)
        };
        let cloudy = Disc {
            pattern: 0.8,
            time: 1234.5,
            ..smooth
        };
        for (deflection, sampling, disc) in [
            (Deflection::Lut, Sampling::Filtered, smooth),
            (Deflection::Lut, Sampling::Single, smooth),
            (Deflection::Flat, Sampling::Filtered, smooth),
            (Deflection::Lut, Sampling::Filtered, cloudy),
            (Deflection::Flat, Sampling::Filtered, cloudy),
        ] {
            let lens: Lens = lens(&view, deflection);
            let scene = Scene::new(lens, grid.clone())
                .with_sampling(sampling)
                .with_disc(disc);
            let reference = cpu::render(&scene, || ());
            for pass in [Pass::Compute, Pass::Fragment] {
                let drawn = on_gpu(&renderer.clone().in_pass(pass), &scene);
                let (some, many) = (
                    different(&drawn, &reference, 1),
                    different(&drawn, &reference, 8),
                );
                println!(
                    "r {radius} {motion} {inclination_deg}° {deflection:?} {sampling:?} {pass:?}, pattern {}: {some} {many}",
                    disc.pattern
                );
                // One ray may be on the other side of an edge. The filter of a GPU's hardware has weights of 8 bits, which
                // changes some edges of the grid by two levels.
                let (most, far) = match sampling {
                    Sampling::Single => (16, 8),
                    Sampling::Filtered | Sampling::Anisotropic => (130, 0),
                };
                if some > most || many > far {
                    worse.push((radius, deflection, sampling, some, many));
                }
            }
        }
    }
    assert!(worse.is_empty(), "{worse:?}");
}

#[test]
fn a_flight_through_the_plane_of_the_disc_does_not_flicker() {
    let black = Arc::new(Sky::from_fn(8, |_| Vec3::ZERO));
    let frame = |i: u32| {
        let view = View {
            latitude_deg: 12.0 - 24.0 * (f64::from(i) + 0.5) / 240.0,
            fov_deg: 60.0,
            width: 240,
            height: 135,
            ..View::default()
        };
        let lens = lens(&view, Deflection::Lut);
        let scene = Scene::new(lens, black.clone()).with_sampling(Sampling::Filtered);
        cpu::render(&scene.with_disc(inclined(90.0)), || ()).srgb(0.0)
    };
    let frames: Vec<_> = (0..240).map(frame).collect();
    let change = |pair: &[Vec<[u8; 3]>]| {
        let pixels = pair[0].iter().zip(&pair[1]);
        let sum: f64 = pixels
            .map(|(a, b)| (0..3).map(|i| f64::from(a[i].abs_diff(b[i]))).sum::<f64>())
            .sum();
        sum / (3.0 * pair[0].len() as f64)
    };
    let changes: Vec<f64> = frames.windows(2).map(change).collect();
    let mut worst = (0.0_f64, 0);
    for (i, near) in changes.windows(3).enumerate() {
        let ratio = near[1] / (0.5 * (near[0] + near[2]) + 0.05);
        if ratio > worst.0 {
            worst = (ratio, i + 1);
        }
    }
    println!(
        "largest change relative to that of its neighbours: {worst:?}; {:?}",
        &changes[110..130]
    );
    assert!(changes.iter().all(|&change| change > 0.05), "it moves");
    assert!(worst.0 < 1.5, "{worst:?}");
}
