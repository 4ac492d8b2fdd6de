//! The pictures as they are drawn: against the closed form, against each other, and by their shadow.

use glam::{DVec3, Vec3};
use lensbake_core::Fate;
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use viewer::camera::{Camera, View};
use viewer::cpu;
use viewer::diff::{PictureDifference, Reference, TraceStatistics};
use viewer::gpu::{Gpu, Renderer};
use viewer::scene::{Method, Scene};
use viewer::sky::{self, Sky, SkySource};

fn scene(view: View, method: Method) -> Scene {
    Scene::new(Camera::new(&view).unwrap(), default_atlas(), method).unwrap()
}

fn half_size(radius: f64) -> View {
    View {
        radius,
        width: 960,
        height: 540,
        ..View::default()
    }
}

/// A sky without detail, for what does not look at it.
fn plain_sky() -> Sky {
    Sky::from_fn(1, |_| Vec3::ONE)
}

/// A sky that changes slowly and everywhere, and has no seam of its own.
fn smooth_sky() -> Sky {
    Sky::from_fn(256, |direction| 0.5 + 0.4 * direction)
}

fn captured(trace: &[Fate<DVec3>]) -> usize {
    trace.iter().filter(|fate| **fate == Fate::Captured).count()
}

/// The largest image-space error (px) of a whole picture drawn by `method`, and how many of its pixels
/// see the sky.
fn image_space_error(gpu: &Gpu, view: View, method: Method) -> (TraceStatistics, usize) {
    let scene = scene(view, method);
    let trace = Renderer::new(gpu, &plain_sky())
        .unwrap()
        .trace(&scene, |_| ())
        .unwrap();
    let reference = Reference::new(&scene, || ());
    let errors = reference.errors(&trace, &reference.trace());
    (
        TraceStatistics::of(&errors).unwrap(),
        trace.len() - captured(&trace),
    )
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_lookup_as_rendered_is_good_to_two_thousandths_of_a_pixel() {
    let gpu = gpu();
    for radius in [2.0, 2.5, 5.0, 10.0, 50.0] {
        let edge = Camera::new(&half_size(radius))
            .unwrap()
            .observer
            .edge_angle()
            .to_degrees();
        // At the edge, which fills no view of its own so near the hole, and away from it.
        for yaw_deg in [edge, 180.0] {
            let view = View {
                radius,
                yaw_deg,
                ..View::default()
            };
            let (statistics, seen) = image_space_error(&gpu, view, Method::Lut);
            println!("r {radius}, yaw {yaw_deg:.1}: {}", statistics.pixels);
            assert!(seen > 500_000, "r {radius}, yaw {yaw_deg}: {seen}");
            assert!(
                statistics.pixels.max <= 0.002,
                "r {radius}, yaw {yaw_deg}: {statistics:?}"
            );
        }
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn direct_integration_on_the_gpu_converges_to_the_closed_form() {
    let gpu = gpu();
    let error = |step| {
        let view = View {
            yaw_deg: 20.0,
            ..half_size(5.0)
        };
        image_space_error(&gpu, view, Method::Direct { step })
            .0
            .pixels
    };
    let (coarse, fine, finest) = (error(0.4), error(0.2), error(0.05));
    assert!(fine.rms < 0.2 * coarse.rms, "{coarse} then {fine}");
    assert!(finest.max < 0.002, "{finest}");
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_lookups_picture_is_the_direct_picture() {
    let gpu = gpu();
    let renderer = Renderer::new(&gpu, &sky::load(&SkySource::Grid).unwrap()).unwrap();
    for radius in [2.5, 10.0] {
        let view = View {
            yaw_deg: 30.0,
            ..half_size(radius)
        };
        let draw = |method| renderer.picture(&scene(view, method), |_| ()).unwrap();
        let lut = draw(Method::Lut);
        let difference = PictureDifference::of(&lut, &draw(Method::Direct { step: 0.05 }));
        assert!(difference.mean < 0.01, "r {radius}: {difference:?}");
        assert!(
            difference.over_two < lut.pixels().len() / 1000,
            "r {radius}: {difference:?}"
        );
        let undeflected = PictureDifference::of(&lut, &draw(Method::Flat));
        assert!(undeflected.mean > 5.0, "r {radius}: {undeflected:?}");
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_what_the_cpu_draws() {
    let gpu = gpu();
    let sky = sky::load(&SkySource::Grid).unwrap();
    let renderer = Renderer::new(&gpu, &sky).unwrap();
    let view = View {
        orbit_deg: 40.0,
        latitude_deg: -25.0,
        yaw_deg: 15.0,
        pitch_deg: 10.0,
        roll_deg: 5.0,
        ..half_size(6.0)
    };
    for method in [Method::Lut, Method::Direct { step: 0.05 }, Method::Flat] {
        let scene = scene(view, method);
        let on_cpu = cpu::render(&scene, &sky, || ());
        let on_gpu = renderer.picture(&scene, |_| ()).unwrap();
        let difference = PictureDifference::of(&on_cpu, &on_gpu);
        assert!(difference.mean < 0.1, "{method:?}: {difference:?}");
        assert!(
            difference.over_two < on_cpu.pixels().len() / 500,
            "{method:?}: {difference:?}"
        );
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_shadow_at_r_10_has_its_radius_within_half_a_pixel() {
    let gpu = gpu();
    let view = View {
        radius: 10.0,
        ..View::default()
    };
    let renderer = Renderer::new(&gpu, &plain_sky()).unwrap();
    for method in [Method::Lut, Method::Direct { step: 0.05 }] {
        let scene = scene(view, method);
        let trace = renderer.trace(&scene, |_| ()).unwrap();
        // sin θ_c = b_c √(1 − 1/r) / r gives 14.26902733°; 90° across 1920 pixels.
        let expected = 960.0 * 14.269_027_33_f64.to_radians().tan();
        let from_area = (captured(&trace) as f64 / std::f64::consts::PI).sqrt();
        assert!(
            (from_area - expected).abs() < 0.5,
            "{method:?}: {from_area} for {expected}"
        );
        let middle = &trace[540 * 1920..541 * 1920];
        let across = captured(middle) as f64 / 2.0;
        assert!(
            (across - expected).abs() < 0.5 + 0.5,
            "{method:?}: {across} for {expected}"
        );
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn there_is_no_second_hole_behind_the_camera_and_no_seam() {
    let gpu = gpu();
    let renderer = Renderer::new(&gpu, &smooth_sky()).unwrap();
    for radius in [1.6, 2.0, 10.0, 1000.0] {
        for (yaw_deg, pitch_deg) in [
            (180.0, 0.0),
            (110.0, 0.0),
            (250.0, 0.0),
            (180.0, 60.0),
            (180.0, -60.0),
        ] {
            let view = View {
                yaw_deg,
                pitch_deg,
                fov_deg: 40.0,
                ..half_size(radius)
            };
            let scene = scene(view, Method::Lut);
            let at = format!("r {radius}, yaw {yaw_deg}, pitch {pitch_deg}");
            assert_eq!(
                captured(&renderer.trace(&scene, |_| ()).unwrap()),
                0,
                "{at}"
            );
            let picture = renderer.picture(&scene, |_| ()).unwrap();
            let jump = largest_jump(picture.pixels(), picture.width() as usize);
            assert!(jump < 0.02, "{at}: {jump}");
        }
    }
}

/// The largest change of light from one pixel to its neighbour on the right or below.
fn largest_jump(pixels: &[[f32; 3]], width: usize) -> f32 {
    let apart = |a: [f32; 3], b: [f32; 3]| (Vec3::from(a) - Vec3::from(b)).abs().max_element();
    let across = pixels
        .chunks_exact(width)
        .flat_map(|row| row.windows(2).map(|w| apart(w[0], w[1])));
    let along = (width..pixels.len()).map(|i| apart(pixels[i], pixels[i - width]));
    across.chain(along).fold(0.0, f32::max)
}
