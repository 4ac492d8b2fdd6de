//! Panoramas, fisheyes and domes: their rays and pictures on the GPU and on the CPU, and their stars.

use glam::{DVec2, DVec3, Vec3};
use lensbake_core::{Motion, RayOutcome};
use lensbake_render::camera::{Camera, Projection, View};
use lensbake_render::cpu;
use lensbake_render::diff::{PictureDifference, Reference, TraceStatistics};
use lensbake_render::gpu::Trace;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::{self, Sky, SkySource};
use lensbake_render::stars::{PointStar, StarField};
use lensbake_tests::{lens, on_gpu, renderer, trace_on_gpu};
use std::sync::Arc;

/// A view at r = 5, turned a little, so that the hole is on no axis of the picture.
fn view(projection: Projection, motion: Motion) -> View {
    let (width, height) = match projection {
        Projection::Equirectangular => (1024, 512),
        _ => (512, 512),
    };
    View {
        radius: 5.0,
        motion,
        yaw_deg: 20.0,
        pitch_deg: -30.0,
        roll_deg: 5.0,
        projection,
        fov_deg: 180.0,
        width,
        height,
        ..View::default()
    }
}

/// Each projection at rest, and once with a boost and once in free fall.
fn views() -> Vec<View> {
    let dome = Projection::Dome { tilt_deg: 15.0 };
    let mut all = [Projection::Equirectangular, Projection::Fisheye, dome]
        .map(|projection| view(projection, Motion::Rest))
        .to_vec();
    all.push(view(Projection::Equirectangular, Motion::Orbit));
    all.push(view(Projection::Fisheye, Motion::Fall));
    all.push(View {
        fov_deg: 300.0,
        ..view(Projection::Fisheye, Motion::Rest)
    });
    all
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_rays_of_every_projection_are_good_to_a_hundredth_of_a_pixel() {
    let renderer = renderer();
    for view in views() {
        let lens = lens(&view, Deflection::Lut);
        let reference = Reference::new(&lens, || ());
        let errors = reference.errors(&trace_on_gpu(&renderer, &lens), &reference.trace());
        let camera = &lens.camera;
        let in_picture = |i: usize| {
            let (column, row) = (i as u32 % camera.width, i as u32 / camera.width);
            camera.coverage(column, row) > 0.0
        };
        let errors = errors.into_iter().enumerate();
        let errors: Vec<_> = errors
            .filter(|(i, _)| in_picture(*i))
            .map(|(_, e)| e)
            .collect();
        let statistics = TraceStatistics::of(&errors).unwrap();
        println!(
            "{:?}, {}: {}",
            view.projection, view.motion, statistics.pixels
        );
        assert!(statistics.pixels.max <= 0.01, "{view:?}: {statistics:?}");
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_pictures_of_every_projection_are_those_of_the_cpu() {
    let renderer = renderer();
    let sky = Arc::new(sky::load(&SkySource::Nebula).unwrap());
    for view in views() {
        let scene = Scene::new(lens(&view, Deflection::Lut), sky.clone())
            .with_sampling(Sampling::Filtered)
            .with_stars(StarField::new(&lensbake_render::stars::hipparcos(), 0.0));
        let difference =
            PictureDifference::of(&on_gpu(&renderer, &scene), &cpu::render(&scene, || ()));
        println!("{:?}, {}: {difference:?}", view.projection, view.motion);
        assert!(difference.max <= 4, "{view:?}: {difference:?}");
        assert!(difference.mean < 0.01, "{view:?}: {difference:?}");
    }
}

/// The direction on the sky at `at` (pixels from the top left corner) between the four pixels around it; `None` unless
/// all of them see the sky.
fn between(camera: &Camera, trace: &Trace, at: DVec2) -> Option<DVec3> {
    let low = (at - 0.5).floor();
    let part = at - 0.5 - low;
    let mut sum = DVec3::ZERO;
    for (right, down) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let share = (1.0 - part.x - right * (1.0 - 2.0 * part.x))
            * (1.0 - part.y - down * (1.0 - 2.0 * part.y));
        let column = (low.x + right).rem_euclid(camera.width.into()) as usize;
        let row = (low.y + down).clamp(0.0, f64::from(camera.height) - 1.0) as usize;
        match trace[row * camera.width as usize + column] {
            RayOutcome::Escapes(direction) => sum += share * direction,
            RayOutcome::Captured => return None,
        }
    }
    Some(sum.normalize())
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn a_panorama_shows_in_a_direction_what_a_camera_shows() {
    let renderer = renderer();
    let mut compared = 0;
    for motion in [Motion::Rest, Motion::Orbit] {
        let panorama = View {
            width: 8192,
            height: 4096,
            ..view(Projection::Equirectangular, motion)
        };
        let whole = lens(&panorama, Deflection::Lut);
        let trace = trace_on_gpu(&renderer, &whole);
        for yaw_deg in [20.0, 110.0, 199.0] {
            let camera = View {
                yaw_deg,
                fov_deg: 60.0,
                width: 480,
                height: 270,
                projection: Projection::Perspective,
                ..panorama
            };
            let lens = lens(&camera, Deflection::Lut);
            let reference = Reference::new(&lens, || ());
            let other: Trace = (0..lens.camera.pixels() as u32)
                .map(|i| {
                    let direction = lens.camera.direction(i % camera.width, i / camera.width);
                    let at = whole.camera.project(direction).unwrap();
                    let seen = between(&whole.camera, &trace, at);
                    seen.map_or(RayOutcome::Captured, RayOutcome::Escapes)
                })
                .collect();
            let seen = trace_on_gpu(&renderer, &lens);
            // Beside the shadow's edge the sky is not linear between two pixels.
            let shadow = lens.camera.observer.shadow_angle();
            let (mut worst, mut count) = (0.0_f64, 0);
            for (i, error) in reference.errors(&other, &seen).iter().enumerate() {
                let (column, row) = (i as u32 % camera.width, i as u32 / camera.width);
                let (direction, _) = lens.camera.unboosted(lens.camera.direction(column, row));
                if direction.angle_between(DVec3::NEG_Z) > shadow + 0.1 {
                    worst = worst.max(error.pixels());
                    count += 1;
                }
            }
            println!("{motion}, yaw {yaw_deg}: {worst:.5} px, {count} pixels");
            assert!(worst <= 0.01, "{motion} {yaw_deg}: {worst}");
            compared += count;
        }
    }
    assert!(compared > 500_000, "{compared}");
}

/// The light of a star at this longitude and latitude of the picture, summed over the solid angles of the pixels, in units
/// of its light, and the direction of its middle.
fn light_of_star(view: &View, longitude_deg: f64, latitude_deg: f64, light: f32) -> (f64, DVec3) {
    let lens: Lens = lens(view, Deflection::Flat);
    let camera = &lens.camera;
    let (right, down) = (camera.right.normalize(), camera.down.normalize());
    let (sin, cos) = longitude_deg.to_radians().sin_cos();
    let (up, across) = latitude_deg.to_radians().sin_cos();
    let direction = (camera.forward * cos + right * sin) * across - down * up;
    let field = StarField {
        stars: vec![PointStar {
            direction: camera.sky_from_hole * direction,
            light: Vec3::splat(light),
        }],
        disc_radius: 1e-6,
    };
    let black = Sky::from_fn(1, |_| Vec3::ZERO);
    let scene = Scene::new(lens.clone(), black).with_stars(field);
    let picture: Picture = cpu::render(&scene, || ());
    let (mut sum, mut middle) = (0.0, DVec3::ZERO);
    for (i, pixel) in picture.pixels().iter().enumerate() {
        let (column, row) = (i as u32 % camera.width, i as u32 / camera.width);
        let at = camera.position(column, row);
        let light = f64::from(pixel[0]) * camera.pixel_solid_angle(at);
        sum += light;
        middle += light * camera.direction(column, row);
    }
    (sum / f64::from(light), direction - middle.normalize())
}

#[test]
fn a_star_keeps_its_light_and_place_wherever_it_is() {
    // The hole is behind the camera and does not bend.
    let panorama = View {
        radius: 1000.0,
        yaw_deg: 180.0,
        ..view(Projection::Equirectangular, Motion::Rest)
    };
    let pixel = std::f64::consts::TAU / f64::from(panorama.width);
    for light in [1.0, 300.0] {
        for (longitude, latitude) in [
            (10.0, 3.0),
            (179.9, -20.0),
            (-180.0, 45.0),
            (77.0, 60.0),
            (30.0, -80.0),
            (120.0, 89.0),
            (0.0, 89.95),
        ] {
            let (sum, off) = light_of_star(&panorama, longitude, latitude, light);
            println!(
                "{light} at {longitude} {latitude}: {sum:.4}, {:.3} px",
                off.length() / pixel
            );
            assert!(
                (sum - 1.0).abs() < 0.01,
                "{light} {longitude} {latitude}: {sum}"
            );
            assert!(
                off.length() < 0.3 * pixel,
                "{light} {longitude} {latitude}: {off}"
            );
        }
    }
    let fisheye = View {
        projection: Projection::Fisheye,
        width: 512,
        height: 512,
        ..panorama
    };
    for (longitude, latitude, light) in [
        (0.0, 0.0, 1.0),
        (45.0, 0.0, 1.0),
        (0.0, 80.0, 1.0),
        (-60.0, -30.0, 1.0),
        (0.0, 0.0, 300.0),
        (70.0, 0.0, 300.0),
        (-70.0, 0.0, 300.0),
        (0.0, 70.0, 300.0),
        (0.0, -70.0, 300.0),
    ] {
        let (sum, off) = light_of_star(&fisheye, longitude, latitude, light);
        println!("fisheye, {light} at {longitude} {latitude}: {sum:.4}");
        assert!((sum - 1.0).abs() < 0.01, "{longitude} {latitude}: {sum}");
        assert!(off.length() < 0.3 * pixel, "{longitude} {latitude}: {off}");
    }
}
