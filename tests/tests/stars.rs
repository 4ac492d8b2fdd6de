//! Drawn point stars against root-finding on the closed form, on the CPU and on the GPU.

use glam::{DVec2, DVec3, Vec3};
use lensbake_core::{Motion, Observer};
use lensbake_render::camera::{Projection, View};
use lensbake_render::cpu;
use lensbake_render::diff::PictureDifference;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::Scene;
use lensbake_render::sky::Sky;
use lensbake_render::stars::images::{ImageOrder, MIN_LIGHT};
use lensbake_render::stars::{self, PointStar, StarField};
use lensbake_studies::flicker::{ExactImage, exact_image};
use lensbake_tests::stars::scene;
use lensbake_tests::{lens, on_gpu, renderer};
use std::f64::consts::TAU;
use std::sync::Arc;

fn on_cpu(scene: &Scene) -> Picture {
    cpu::render(scene, || ())
}

/// One star of this light at `beta` from the direction of the hole, to the right of it.
fn one_star(lens: &Lens, beta: f64, light: f64, disc_radius: f64) -> StarField {
    let in_hole = DVec3::new(beta.sin(), 0.0, -beta.cos());
    StarField {
        stars: vec![PointStar {
            direction: lens.camera.sky_from_hole * in_hole,
            light: Vec3::splat(light as f32),
        }],
        disc_radius,
    }
}

/// The light within 6 pixels of a point of the picture, and its centroid.
fn light_near(picture: &Picture, at: DVec2) -> (f64, DVec2) {
    let (mut sum, mut centre) = (0.0, DVec2::ZERO);
    for (i, pixel) in picture.pixels().iter().enumerate() {
        let (column, row) = (i as u32 % picture.width(), i as u32 / picture.width());
        let middle = DVec2::new(column.into(), row.into()) + 0.5;
        if (middle - at).length() < 6.0 {
            sum += f64::from(pixel[1]);
            centre += f64::from(pixel[1]) * middle;
        }
    }
    (sum, centre / sum)
}

/// Angular size of a pixel in the middle of a picture of 1920 × 1080 pixels and 90°, rad.
const PIXEL: f64 = 2.0 / 1920.0;

/// Factor by which pixels must be finer than [`PIXEL`] for the image `target` to be clear of the halo of a
/// brighter image on its side.
fn zoom(roots: &[ExactImage], target: &ExactImage) -> f64 {
    let brighter = roots
        .iter()
        .filter(|root| root.side == target.side && root.theta > target.theta);
    let apart = brighter.map(|root| root.theta - target.theta);
    (50.0 * PIXEL / apart.fold(f64::INFINITY, f64::min)).max(1.0)
}

/// Draws the first four images of a star at `beta` one by one, each with the light of one white pixel, in the
/// middle of a picture, and compares position and light.
fn check_images(draw: impl Fn(&Scene) -> Picture, radius: f64, beta: f64) {
    let observer = Observer::at(radius).unwrap();
    let orders: Vec<ImageOrder> = ImageOrder::all().flatten().collect();
    let roots: Vec<ExactImage> = orders
        .iter()
        .map(|order| exact_image(&observer, beta, *order).unwrap())
        .collect();
    for target in &roots[..4] {
        let zoom = zoom(&roots, target);
        let view = View {
            radius,
            motion: Motion::Rest,
            heading_deg: 0.0,
            orbit_deg: 33.0,
            latitude_deg: 11.0,
            // A little aside, so that the image falls between pixel centres.
            yaw_deg: (target.side * target.theta).to_degrees() + 0.123 / zoom,
            pitch_deg: 0.456 / zoom,
            roll_deg: 10.0,
            projection: Projection::Perspective,
            fov_deg: 2.0 * (0.5 * 192.0 * PIXEL / zoom).atan().to_degrees(),
            width: 192,
            height: 108,
        };
        let lens = lens(&view, Deflection::Lut);
        let light = 1.0 / target.magnification;
        let picture = draw(&scene(&lens, &one_star(&lens, beta, light, 1e-8)));
        // Expected there: the image itself, and those of higher order that lie in the same pixels.
        let (mut expected, mut centre) = (0.0, DVec2::ZERO);
        let position = |root: &ExactImage| {
            let (sin, cos) = root.theta.sin_cos();
            let direction = DVec3::new(root.side * sin, 0.0, -cos);
            lens.camera.project(direction)
        };
        let place = position(target).unwrap();
        for root in &roots {
            let part = light * root.magnification;
            let near = position(root).filter(|at| (at - place).length() < 6.0);
            if let Some(at) = near.filter(|_| part >= f64::from(MIN_LIGHT)) {
                expected += part;
                centre += part * at;
            }
        }
        let centre = centre / expected;
        let (found, found_centre) = light_near(&picture, place);
        let (off_px, off) = (
            (found_centre - centre).length() / zoom,
            found / expected - 1.0,
        );
        let at = format!("r {radius}, beta {beta}, {target:?}");
        #[expect(
            clippy::print_stdout,
            reason = "figures for the person who runs the test"
        )]
        {
            println!("{at}: {off_px:.1e} px, flux {off:+.1e}");
        }
        assert!(off_px < 0.01, "{at}: {off_px} px");
        assert!(off.abs() < 1e-3, "{at}: flux {off}");
    }
}

/// Radius of the camera, and angle of the star from the hole: near the axis, aside, and behind the camera.
const CASES: [(f64, f64); 7] = [
    (25.0, 0.02),
    (25.0, 0.3),
    (25.0, 1.5),
    (5.0, 0.7),
    (2.0, 0.05),
    (2.0, 2.5),
    (1.3, 1.0),
];

#[test]
fn the_cpu_draws_four_images_where_and_as_bright_as_they_are() {
    for (radius, beta) in CASES {
        check_images(on_cpu, radius, beta);
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_four_images_where_and_as_bright_as_they_are() {
    let renderer = renderer();
    for (radius, beta) in CASES {
        check_images(|scene| on_gpu(&renderer, scene), radius, beta);
    }
}

fn half_size(radius: f64) -> View {
    View {
        radius,
        width: 480,
        height: 480,
        fov_deg: 60.0,
        ..View::default()
    }
}

/// The light of a ring in 24 sectors about the middle of the picture, and its sum.
fn ring(picture: &Picture) -> (Vec<f64>, f64) {
    let mut parts = vec![0.0; 24];
    for (i, pixel) in picture.pixels().iter().enumerate() {
        let (column, row) = (i as u32 % picture.width(), i as u32 / picture.width());
        let x = f64::from(column) + 0.5 - 0.5 * f64::from(picture.width());
        let y = f64::from(row) + 0.5 - 0.5 * f64::from(picture.height());
        let turn = y.atan2(x).rem_euclid(TAU) / TAU;
        parts[(turn * 24.0) as usize % 24] += f64::from(pixel[1]);
    }
    let sum = parts.iter().sum();
    (parts, sum)
}

fn check_ring(draw: impl Fn(&Scene) -> Picture) {
    let lens = lens(&half_size(25.0), Deflection::Lut);
    // sin θ dθ/dϑ at ϑ = 0, −2π: the mean magnification of the disc is 2/ρ times this for each of the two images.
    let observer = &lens.camera.observer;
    let on_axis = |windings| {
        let order = ImageOrder {
            side: 1.0,
            windings,
        };
        exact_image(observer, 1e-6, order).unwrap().magnification * 1e-6
    };
    for radius in [1.5e-8, 1e-4] {
        let light = 1e3 * radius;
        let expected = 4.0 / radius * light * (on_axis(0) + on_axis(1));
        let (parts, sum) = ring(&draw(&scene(&lens, &one_star(&lens, 0.0, light, radius))));
        assert!((sum / expected - 1.0).abs() < 2e-3, "{sum} for {expected}");
        let mean = sum / 24.0;
        for part in &parts {
            assert!(
                (part / mean - 1.0).abs() < 0.05,
                "{part} of {mean}: {parts:?}"
            );
        }
    }
    // Off the axis by less than the disc's radius, the ring is still closed; by more, there are two arcs.
    let star = |ratio: f64| one_star(&lens, ratio * 1e-4, 0.1, 1e-4);
    let (parts, _) = ring(&draw(&scene(&lens, &star(0.5))));
    assert!(parts.iter().all(|part| *part > 0.0), "{parts:?}");
    let (parts, _) = ring(&draw(&scene(&lens, &star(2.0))));
    let lit = parts.iter().filter(|part| **part > 0.0).count();
    assert!(
        (8..=12).contains(&lit),
        "two arcs of 60° in parts of 15°: {lit}"
    );
}

#[test]
fn on_the_axis_the_cpu_draws_a_closed_ring() {
    check_ring(on_cpu);
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn on_the_axis_the_gpu_draws_a_closed_ring() {
    let renderer = renderer();
    check_ring(|scene| on_gpu(&renderer, scene));
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_the_stars_that_the_cpu_draws() {
    let renderer = renderer();
    let field = StarField::new(&stars::hipparcos(), 0.0);
    for (radius, yaw_deg, method) in [
        (25.0, 0.0, Deflection::Lut),
        (2.5, 90.0, Deflection::Lut),
        (10.0, 10.0, Deflection::Direct { step: 0.05 }),
        (4.0, 20.0, Deflection::Flat),
    ] {
        let view = View {
            orbit_deg: 80.0,
            latitude_deg: 5.0,
            yaw_deg,
            ..half_size(radius)
        };
        let scene = scene(&lens(&view, method), &field);
        let (on_cpu, on_gpu) = (on_cpu(&scene), on_gpu(&renderer, &scene));
        let sum = |picture: &Picture| {
            let light = picture
                .pixels()
                .iter()
                .map(|p| f64::from(p[0] + p[1] + p[2]));
            light.sum::<f64>()
        };
        let (cpu_sum, gpu_sum) = (sum(&on_cpu), sum(&on_gpu));
        assert!(cpu_sum > 100.0, "{method:?} at r {radius}: {cpu_sum}");
        assert!(
            (gpu_sum / cpu_sum - 1.0).abs() < 2e-4,
            "{method:?} at r {radius}: {gpu_sum} for {cpu_sum}"
        );
        let difference = PictureDifference::of(&on_cpu, &on_gpu);
        assert!(
            difference.mean < 0.01 && difference.over_two < 20,
            "{method:?} at r {radius}: {difference:?}"
        );
    }
}

/// Stars add the same light to any sky, and change nothing else.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn a_sky_and_its_stars_add_up() {
    let renderer = renderer();
    let sky = Arc::new(Sky::from_fn(64, |direction| 0.1 + 0.05 * direction));
    let field = StarField::new(&stars::hipparcos(), 2.0);
    let lens = lens(&half_size(8.0), Deflection::Lut);
    let plain = Scene::new(lens.clone(), sky);
    let alone = on_gpu(&renderer, &plain);
    let stars = on_gpu(&renderer, &scene(&lens, &field));
    let both = on_gpu(&renderer, &plain.with_stars(field));
    let mut lit = 0;
    for ((both, sky), stars) in both.pixels().iter().zip(alone.pixels()).zip(stars.pixels()) {
        for ((both, sky), stars) in both.iter().zip(sky).zip(stars) {
            assert!(
                (both - sky - stars).abs() <= 1e-5 * (1.0 + stars),
                "{both} {sky} {stars}"
            );
            lit += u32::from(*stars > 0.0);
        }
    }
    assert!(lit > 10_000, "{lit}");
}
