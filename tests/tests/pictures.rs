//! Drawn pictures: against the closed form, against each other, and the size of the shadow in them.

use glam::{DVec3, Vec3};
use lensbake_core::RayOutcome;
use lensbake_render::camera::{Camera, View};
use lensbake_render::cpu;
use lensbake_render::diff::{PictureDifference, Reference, TraceStatistics};
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::Deflection;
use lensbake_render::scene::Scene;
use lensbake_render::sky::{self, Sky, SkySource};
use lensbake_tests::{lens, on_gpu, renderer, trace_on_gpu};
use std::sync::Arc;

fn half_size(radius: f64) -> View {
    View {
        radius,
        width: 960,
        height: 540,
        ..View::default()
    }
}

/// A sky that changes slowly and everywhere, and has no seam of its own.
fn smooth_sky() -> Sky {
    Sky::from_fn(256, |direction| 0.5 + 0.4 * direction)
}

fn captured(trace: &[RayOutcome<DVec3>]) -> usize {
    trace
        .iter()
        .filter(|outcome| **outcome == RayOutcome::Captured)
        .count()
}

/// Statistics of the image-space error of a whole picture drawn by `deflection`, and the number of its pixels that
/// see the sky.
fn image_space_error(
    renderer: &Renderer,
    view: View,
    deflection: Deflection,
) -> (TraceStatistics, usize) {
    let lens = lens(&view, deflection);
    let trace = trace_on_gpu(renderer, &lens);
    let reference = Reference::new(&lens, || ());
    let errors = reference.errors(&trace, &reference.trace());
    (
        TraceStatistics::of(&errors).unwrap(),
        trace.len() - captured(&trace),
    )
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_lookup_as_rendered_is_good_to_two_thousandths_of_a_pixel() {
    let renderer = renderer();
    for radius in [2.0, 2.5, 5.0, 10.0, 50.0] {
        let edge = Camera::new(&half_size(radius))
            .unwrap()
            .observer
            .shadow_angle()
            .to_degrees();
        // Views at the shadow's edge (near the hole the shadow fills the view ahead) and away from the hole.
        for yaw_deg in [edge, 180.0] {
            let view = View {
                radius,
                yaw_deg,
                ..View::default()
            };
            let (statistics, seen) = image_space_error(&renderer, view, Deflection::Lut);
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
    let renderer = renderer();
    let error = |step| {
        let view = View {
            yaw_deg: 20.0,
            ..half_size(5.0)
        };
        image_space_error(&renderer, view, Deflection::Direct { step })
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
    let renderer = renderer();
    let sky = Arc::new(sky::load(&SkySource::Grid).unwrap());
    for radius in [2.5, 10.0] {
        let view = View {
            yaw_deg: 30.0,
            ..half_size(radius)
        };
        let draw = |deflection| {
            let scene = Scene::new(lens(&view, deflection), sky.clone());
            on_gpu(&renderer, &scene)
        };
        let lut = draw(Deflection::Lut);
        let difference = PictureDifference::of(&lut, &draw(Deflection::Direct { step: 0.05 }));
        assert!(difference.mean < 0.01, "r {radius}: {difference:?}");
        assert!(
            difference.over_two < lut.pixels().len() / 1000,
            "r {radius}: {difference:?}"
        );
        let undeflected = PictureDifference::of(&lut, &draw(Deflection::Flat));
        assert!(undeflected.mean > 5.0, "r {radius}: {undeflected:?}");
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_what_the_cpu_draws() {
    let renderer = renderer();
    let sky = Arc::new(sky::load(&SkySource::Grid).unwrap());
    let view = View {
        orbit_deg: 40.0,
        latitude_deg: -25.0,
        yaw_deg: 15.0,
        pitch_deg: 10.0,
        roll_deg: 5.0,
        ..half_size(6.0)
    };
    for method in [
        Deflection::Lut,
        Deflection::Direct { step: 0.05 },
        Deflection::Flat,
    ] {
        let scene = Scene::new(lens(&view, method), sky.clone());
        let on_cpu = cpu::render(&scene, || ());
        let on_gpu = on_gpu(&renderer, &scene);
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
    let renderer = renderer();
    let view = View {
        radius: 10.0,
        ..View::default()
    };
    for method in [Deflection::Lut, Deflection::Direct { step: 0.05 }] {
        let trace = trace_on_gpu(&renderer, &lens(&view, method));
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
    let renderer = renderer();
    let sky = Arc::new(smooth_sky());
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
            let lens = lens(&view, Deflection::Lut);
            let at = format!("r {radius}, yaw {yaw_deg}, pitch {pitch_deg}");
            assert_eq!(captured(&trace_on_gpu(&renderer, &lens)), 0, "{at}");
            let picture = on_gpu(&renderer, &Scene::new(lens, sky.clone()));
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
