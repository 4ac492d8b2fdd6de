//! Point stars as they are drawn: against root-finding on the closed form, on the CPU and on the GPU.

use glam::{DVec2, DVec3, Vec3};
use lensbake_core::Observer;
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use lensbake_tests::stars::{black, on_cpu, on_gpu};
use std::f64::consts::TAU;
use viewer::camera::{Camera, View};
use viewer::diff::PictureDifference;
use viewer::flicker::{ExactImage, exact_image};
use viewer::gpu::Renderer;
use viewer::picture::Picture;
use viewer::scene::{Method, Scene};
use viewer::sky::Sky;
use viewer::stars::images::{FAINTEST, Way};
use viewer::stars::{self, PointStar, StarField};

fn scene(view: &View, method: Method) -> Scene {
    Scene::new(Camera::new(view).unwrap(), default_atlas(), method).unwrap()
}

/// One star of this light at `beta` from the direction of the hole, to the right of it.
fn one_star(scene: &Scene, beta: f64, light: f64, disc_radius: f64) -> StarField {
    let in_hole = DVec3::new(beta.sin(), 0.0, -beta.cos());
    StarField {
        stars: vec![PointStar {
            direction: scene.camera.sky_from_hole * in_hole,
            light: Vec3::splat(light as f32),
        }],
        disc_radius,
    }
}

/// The light within 6 pixels of a point of the picture, and its centre.
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

/// The angle of a pixel in the middle of 1920 × 1080 pixels at 90°, rad.
const PIXEL: f64 = 2.0 / 1920.0;

/// How many times finer the pixels must be than [`PIXEL`] for the image at `target` to be clear of the halo of
/// a brighter one on its side.
fn zoom(roots: &[ExactImage], target: &ExactImage) -> f64 {
    let brighter = roots
        .iter()
        .filter(|root| root.side == target.side && root.theta > target.theta);
    let apart = brighter.map(|root| root.theta - target.theta);
    (50.0 * PIXEL / apart.fold(f64::INFINITY, f64::min)).max(1.0)
}

/// Draws the first four images of a star at `beta` one by one, each with the light of one white pixel, in the
/// middle of a picture, and compares place and light.
fn check_images(draw: impl Fn(&Scene, &StarField) -> Picture, radius: f64, beta: f64) {
    let observer = Observer::at(radius).unwrap();
    let ways: Vec<Way> = Way::all().flatten().collect();
    let roots: Vec<ExactImage> = ways
        .iter()
        .map(|way| exact_image(&observer, beta, *way).unwrap())
        .collect();
    for target in &roots[..4] {
        let zoom = zoom(&roots, target);
        let view = View {
            radius,
            orbit_deg: 33.0,
            latitude_deg: 11.0,
            // A little aside, so that it falls between the pixels.
            yaw_deg: (target.side * target.theta).to_degrees() + 0.123 / zoom,
            pitch_deg: 0.456 / zoom,
            roll_deg: 10.0,
            fov_deg: 2.0 * (0.5 * 192.0 * PIXEL / zoom).atan().to_degrees(),
            width: 192,
            height: 108,
        };
        let scene = scene(&view, Method::Lut);
        let light = 1.0 / target.magnification;
        let picture = draw(&scene, &one_star(&scene, beta, light, 1e-8));
        // What is seen there: the image itself, and those that wind further but lie in the same pixels.
        let (mut expected, mut centre) = (0.0, DVec2::ZERO);
        let position = |root: &ExactImage| {
            let (sin, cos) = root.theta.sin_cos();
            let direction = DVec3::new(root.side * sin, 0.0, -cos);
            scene.camera.project(direction)
        };
        let place = position(target).unwrap();
        for root in &roots {
            let part = light * root.magnification;
            let near = position(root).filter(|at| (at - place).length() < 6.0);
            if let Some(at) = near.filter(|_| part >= f64::from(FAINTEST)) {
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

/// Radius and angle of the star from the hole: near the axis, aside, and behind the camera.
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
    let gpu = gpu();
    for (radius, beta) in CASES {
        check_images(|scene, field| on_gpu(&gpu, scene, field), radius, beta);
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

/// A star on the axis: the light by direction about the middle of the picture in 24 parts, and in all.
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

fn check_ring(draw: impl Fn(&Scene, &StarField) -> Picture) {
    let scene = scene(&half_size(25.0), Method::Lut);
    // sin θ dθ/dϑ at ϑ = 0, −2π: the disc's mean magnification is 2/ρ of it for either of two images.
    let observer = &scene.camera.observer;
    let on_axis = |windings| {
        let way = Way {
            side: 1.0,
            windings,
        };
        exact_image(observer, 1e-6, way).unwrap().magnification * 1e-6
    };
    for radius in [1.5e-8, 1e-4] {
        let light = 1e3 * radius;
        let expected = 4.0 / radius * light * (on_axis(0) + on_axis(1));
        let (parts, sum) = ring(&draw(&scene, &one_star(&scene, 0.0, light, radius)));
        assert!((sum / expected - 1.0).abs() < 2e-3, "{sum} for {expected}");
        let mean = sum / 24.0;
        for part in &parts {
            assert!(
                (part / mean - 1.0).abs() < 0.05,
                "{part} of {mean}: {parts:?}"
            );
        }
    }
    // Off the axis by less than its radius: still closed; by more: two arcs.
    let star = |ratio: f64| one_star(&scene, ratio * 1e-4, 0.1, 1e-4);
    let (parts, _) = ring(&draw(&scene, &star(0.5)));
    assert!(parts.iter().all(|part| *part > 0.0), "{parts:?}");
    let (parts, _) = ring(&draw(&scene, &star(2.0)));
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
    let gpu = gpu();
    check_ring(|scene, field| on_gpu(&gpu, scene, field));
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_the_stars_that_the_cpu_draws() {
    let gpu = gpu();
    let field = StarField::new(&stars::hipparcos(), 0.0);
    let renderer = Renderer::new(&gpu, &black()).unwrap().with_stars(&field);
    for (radius, yaw_deg, method) in [
        (25.0, 0.0, Method::Lut),
        (2.5, 90.0, Method::Lut),
        (10.0, 10.0, Method::Direct { step: 0.05 }),
        (4.0, 20.0, Method::Flat),
    ] {
        let view = View {
            orbit_deg: 80.0,
            latitude_deg: 5.0,
            yaw_deg,
            ..half_size(radius)
        };
        let scene = scene(&view, method);
        let (on_cpu, on_gpu) = (
            on_cpu(&scene, &field),
            renderer.picture(&scene, |_| ()).unwrap(),
        );
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

/// Stars are the same light before any sky, and nothing else changes.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn a_sky_and_its_stars_add_up() {
    let gpu = gpu();
    let sky = Sky::from_fn(64, |direction| 0.1 + 0.05 * direction);
    let field = StarField::new(&stars::hipparcos(), 2.0);
    let scene = scene(&half_size(8.0), Method::Lut);
    let plain = Renderer::new(&gpu, &sky).unwrap();
    let alone = plain.picture(&scene, |_| ()).unwrap();
    let stars = on_gpu(&gpu, &scene, &field);
    let both = plain.with_stars(&field).picture(&scene, |_| ()).unwrap();
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
