//! Pictures of observers in motion: against the closed form, through the horizon, and on the GPU against the CPU.

use glam::{DVec3, Vec3};
use lensbake_core::{Motion, Observer};
use lensbake_render::camera::{Camera, View};
use lensbake_render::cpu;
use lensbake_render::diff::{PictureDifference, Reference, TraceStatistics};
use lensbake_render::exposure;
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::Deflection;
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::{Rendition, Shift};
use lensbake_render::sky::{self, Sky, SkySource};
use lensbake_render::stars::{StarField, hipparcos};
use lensbake_tables::statistics::ErrorStatistics;
use lensbake_tests::{lens, on_gpu, renderer, trace_on_gpu};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

const GAMMA_100: Motion = Motion::Velocity {
    radial: 0.0,
    tangential: 0.999_95,
};

fn view(radius: f64, motion: Motion, yaw_deg: f64) -> View {
    View {
        radius,
        motion,
        yaw_deg,
        ..View::default()
    }
}

fn small(radius: f64, motion: Motion, yaw_deg: f64) -> View {
    View {
        width: 320,
        height: 180,
        ..view(radius, motion, yaw_deg)
    }
}

/// θ_c of the observer in free fall at `radius`, degrees.
fn edge(radius: f64) -> f64 {
    Observer::falling(radius)
        .unwrap()
        .shadow_angle()
        .to_degrees()
}

fn statistics(renderer: &Renderer, view: &View) -> TraceStatistics {
    let lens = lens(view, Deflection::Lut);
    let trace = trace_on_gpu(renderer, &lens);
    let reference = Reference::new(&lens, || ());
    let errors = reference.errors(&trace, &reference.trace());
    TraceStatistics::of(&errors).unwrap()
}

/// Views at the shadow's edge and straight away, 1920 × 1080 pixels and 90° across. Straight away a pixel covers only
/// 1/(1 + √(1/r)) of its angle on the sky, which at r = 0.1 is so little that rounding to f32 takes the whole bound.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_lookup_of_a_moving_observer_is_good_to_two_thousandths_of_a_pixel() {
    let renderer = renderer();
    let falling = [10.0, 2.0, 1.0, 0.5, 0.1].map(|r| (r, Motion::Fall, edge(r)));
    let orbiting = [3.0, 6.0].map(|r| (r, Motion::Orbit, 30.0));
    for (radius, motion, at_edge) in falling.into_iter().chain(orbiting) {
        for yaw_deg in [at_edge, 180.0] {
            let errors = statistics(&renderer, &view(radius, motion, yaw_deg));
            println!("{motion} r {radius}, yaw {yaw_deg:.1}: {}", errors.pixels);
            let bound = match (radius, yaw_deg) {
                (0.1, 180.0) => 0.0025,
                _ => 0.002,
            };
            assert!(
                errors.pixels.max <= bound,
                "{motion} {radius} {yaw_deg}: {errors:?}"
            );
            assert_eq!(errors.differing_outcomes, 0);
        }
    }
}

/// At γ = 100 a pixel straight ahead covers 200 times its angle on the sky, and one behind 1/200. The error on the sky is
/// that of a direction in f32 wherever one looks; up to 20° from the motion it is below two thousandths of a pixel.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_error_at_gamma_100_is_that_of_a_direction_in_f32() {
    let renderer = renderer();
    for yaw_deg in [90.0, 0.0, 180.0, -90.0] {
        let lens = lens(&view(10.0, GAMMA_100, yaw_deg), Deflection::Lut);
        let camera = lens.camera;
        let reference = Reference::new(&lens, || ());
        let errors = reference.errors(&trace_on_gpu(&renderer, &lens), &reference.trace());
        let from_motion = |index: usize| {
            let (column, row) = (index as u32 % camera.width, index as u32 / camera.width);
            camera
                .direction(column, row)
                .angle_between(DVec3::X)
                .to_degrees()
        };
        let all = TraceStatistics::of(&errors).unwrap();
        println!("yaw {yaw_deg}: {} rad, {} px", all.radians, all.pixels);
        assert!(all.radians.p999 < 4e-7, "yaw {yaw_deg}: {all:?}");
        assert_eq!(all.differing_outcomes, 0);
        if yaw_deg == 90.0 {
            let ahead = errors
                .iter()
                .enumerate()
                .filter(|(i, _)| from_motion(*i) < 20.0);
            let ahead = ErrorStatistics::of(ahead.map(|(_, error)| error.pixels())).unwrap();
            println!("up to 20 degrees from the motion: {ahead}");
            assert!(ahead.max <= 0.002, "{ahead}");
        }
    }
}

/// A sky that changes slowly and everywhere, and has no seam of its own.
fn smooth_sky() -> Arc<Sky> {
    Arc::new(Sky::from_fn(256, |direction| 0.5 + 0.4 * direction))
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_picture_is_continuous_through_the_horizon() {
    let renderer = renderer();
    for sky in [
        smooth_sky(),
        Arc::new(sky::load(&SkySource::Nebula).unwrap()),
    ] {
        for yaw_deg in [0.0, 60.0, 180.0] {
            for shift in [Shift::Off, Shift::Colour] {
                let scene = |radius| {
                    let lens = lens(&small(radius, Motion::Fall, yaw_deg), Deflection::Lut);
                    Scene::new(lens, sky.clone())
                        .with_sampling(Sampling::Filtered)
                        .with_shift(shift)
                };
                let (above, below) = (scene(1.0 + 1e-6), scene(1.0 - 1e-6));
                let stops = exposure::automatic(&above.lens, shift);
                let frames = |draw: &dyn Fn(&Scene) -> Picture| {
                    let [a, b] = [&above, &below].map(|scene| draw(scene).srgb(stops));
                    PictureDifference::on_screen(&a, &b)
                };
                for difference in [
                    frames(&|scene| cpu::render(scene, || ())),
                    frames(&|scene| on_gpu(&renderer, scene)),
                ] {
                    assert!(difference.max <= 1, "yaw {yaw_deg}: {difference:?}");
                }
            }
        }
    }
}

/// The distances from the picture's centre at which it turns from black to the sky, along the axes, against the angular
/// radius of the shadow in free fall that was computed independently of this project.
#[test]
fn the_shadow_of_the_falling_observer_has_its_size_in_the_picture() {
    let white = Arc::new(Sky::from_fn(1, |_| Vec3::ONE));
    for (radius, degrees) in [
        (10.0, 10.310_109_f64),
        (3.0, 24.203_428),
        (1.5, 35.264_390),
        (1.0, 42.103_449),
        (0.5, 53.270_266),
        (0.1, 72.263_813),
    ] {
        let view = View {
            fov_deg: 160.0,
            width: 1001,
            height: 1001,
            ..small(radius, Motion::Fall, 0.0)
        };
        let scene = Scene::new(lens(&view, Deflection::Lut), white.clone())
            .with_sampling(Sampling::Filtered);
        let picture = cpu::render(&scene, || ());
        let dark = |index: usize| 1.0 - f64::from(picture.pixels()[index][0]);
        let across: f64 = (0..1001).map(|x| dark(500 * 1001 + x)).sum();
        let along: f64 = (0..1001).map(|y| dark(y * 1001 + 500)).sum();
        let expected = 500.5 * degrees.to_radians().tan() / (80f64).to_radians().tan();
        for diameter in [across, along] {
            let off = 0.5 * diameter - expected;
            assert!(off.abs() < 0.5, "r {radius}: {off} px of {expected}");
        }
    }
}

/// Everything at once: stars, filter and colour, for every kind of motion.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_what_the_cpu_draws() {
    let renderer = renderer();
    let sky = Arc::new(sky::load(&SkySource::Nebula).unwrap());
    let stars = Arc::new(StarField::new(&hipparcos(), 0.0));
    let velocity = |radial, tangential| Motion::Velocity { radial, tangential };
    for (radius, motion, yaw_deg, shift) in [
        (10.0, Motion::Fall, 0.0, Shift::Colour),
        (1.0, Motion::Fall, 45.0, Shift::Brightness),
        (0.3, Motion::Fall, 90.0, Shift::Colour),
        (0.05, Motion::Fall, 180.0, Shift::Off),
        (500.0, Motion::Fall, 0.0, Shift::Off),
        (3.0, Motion::Orbit, 40.0, Shift::Colour),
        (3.0, Motion::Orbit, 200.0, Shift::Off),
        (6.0, velocity(0.5, -0.8), 300.0, Shift::Brightness),
        (0.6, velocity(0.3, 0.6), 80.0, Shift::Colour),
        (10.0, GAMMA_100, 90.0, Shift::Off),
    ] {
        let view = View {
            heading_deg: 25.0,
            ..small(radius, motion, yaw_deg)
        };
        for sampling in [Sampling::Filtered, Sampling::Single] {
            let lens = lens(&view, Deflection::Lut);
            let stops = exposure::automatic(&lens, shift);
            let scene = Scene::new(lens, sky.clone())
                .with_sampling(sampling)
                .with_stars(stars.clone())
                .with_shift(shift);
            let [cpu, gpu] = [cpu::render(&scene, || ()), on_gpu(&renderer, &scene)];
            let difference = PictureDifference::on_screen(&cpu.srgb(stops), &gpu.srgb(stops));
            println!(
                "{motion} r {radius} {} {sampling:?}: {difference:?}",
                shift.name()
            );
            assert!(difference.mean < 0.1, "{motion} r {radius}: {difference:?}");
            assert!(
                difference.over_two < 60,
                "{motion} r {radius}: {difference:?}"
            );
        }
    }
}

/// Automatic exposure scales the light before the picture is stored, and the stars before the faint ones are left out. The
/// picture is the one that is exposed afterwards, except for those stars and their halos.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_light_of_a_rendition_is_scaled_as_by_an_exposure() {
    let renderer = renderer();
    let sky = smooth_sky();
    for (radius, yaw_deg, shift) in [(1.0, 45.0, Shift::Brightness), (0.3, 120.0, Shift::Colour)] {
        let lens = lens(&small(radius, Motion::Fall, yaw_deg), Deflection::Lut);
        let stops = exposure::automatic(&lens, shift);
        assert!(stops.abs() > 0.3, "{stops}");
        let scene = Scene::new(lens, sky.clone())
            .with_sampling(Sampling::Filtered)
            .with_shift(shift);
        let scaled = Scene {
            rendition: Rendition {
                shift,
                light_scale: stops.exp2(),
            },
            ..scene.clone()
        };
        for draw in [
            &(|scene: &Scene| cpu::render(scene, || ())) as &dyn Fn(&Scene) -> Picture,
            &|scene: &Scene| on_gpu(&renderer, scene),
        ] {
            let (exposed, scaled) = (draw(&scene).srgb(stops), draw(&scaled).srgb(0.0));
            let difference = PictureDifference::on_screen(&exposed, &scaled);
            assert!(difference.max <= 1, "r {radius}: {difference:?}");
        }
    }
}

/// A boost along the radius in the shader and the row of the falling observer are two ways to the same picture.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_row_of_the_falling_observer_and_a_boost_draw_the_same() {
    let renderer = renderer();
    for radius in [50.0f64, 10.0, 2.0, 1.01] {
        let boost = Motion::Velocity {
            radial: -(1.0 / radius).sqrt(),
            tangential: 0.0,
        };
        let yaw_deg = 20.0;
        let [by_row, by_boost] = [Motion::Fall, boost].map(|motion| {
            let lens = lens(&small(radius, motion, yaw_deg), Deflection::Lut);
            let scene = Scene::new(lens, smooth_sky()).with_sampling(Sampling::Filtered);
            on_gpu(&renderer, &scene).srgb(0.0)
        });
        let difference = PictureDifference::on_screen(&by_row, &by_boost);
        assert!(difference.max <= 1, "r {radius}: {difference:?}");
    }
}

/// Direct integration below the horizon is the textbook method in another frame: it meets the table.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn direct_integration_meets_the_table_below_the_horizon() {
    let renderer = renderer();
    for (radius, motion, yaw_deg) in [
        (3.0, Motion::Fall, 60.0),
        (1.0, Motion::Fall, 90.0),
        (0.5, Motion::Fall, 120.0),
        (0.3, Motion::Fall, 60.0),
        (3.0, Motion::Orbit, 60.0),
    ] {
        let view = small(radius, motion, yaw_deg);
        let direct = lens(&view, Deflection::Direct { step: 0.01 });
        let reference = Reference::new(&lens(&view, Deflection::Lut), || ());
        let errors = reference.errors(&trace_on_gpu(&renderer, &direct), &reference.trace());
        let errors = TraceStatistics::of(&errors).unwrap();
        println!("{motion} r {radius}: {}", errors.pixels);
        assert!(errors.pixels.p999 < 0.01, "{motion} r {radius}: {errors:?}");
        assert!(errors.differing_outcomes < 5, "{errors:?}");
    }
    let camera = Camera::new(&small(1.0, Motion::Fall, 0.0)).unwrap();
    assert!(camera.observer.shadow_angle() < FRAC_PI_2);
}
