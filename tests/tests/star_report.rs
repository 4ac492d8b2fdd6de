//! The window says so when the GPU has no room for all stars: what a live picture tells of its last frames.

use glam::Vec3;
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use std::time::{Duration, Instant};
use viewer::camera::{Camera, View};
use viewer::gpu::{Gpu, Live, Renderer, Show, StarLight, Stopwatch};
use viewer::scene::{Method, Scene};
use viewer::sky::Sky;
use viewer::stars::{self, StarField};

fn scene() -> Scene {
    let view = View {
        width: 160,
        height: 90,
        ..View::default()
    };
    Scene::new(Camera::new(&view).unwrap(), default_atlas(), Method::Lut).unwrap()
}

fn live(gpu: &Gpu, scene: &Scene, stops: Option<f64>) -> Live {
    let renderer = Renderer::new(gpu, &Sky::from_fn(1, |_| Vec3::ZERO)).unwrap();
    let size = [scene.camera.width, scene.camera.height];
    let mut live = Live::new(renderer, &scene.row, size, &[0.05]);
    live.set_stars(field(stops).as_ref());
    live
}

fn field(stops: Option<f64>) -> Option<StarField> {
    stops.map(|stops| StarField::new(&stars::hipparcos(), stops))
}

/// What a frame tells, when it has come back.
fn report(gpu: &Gpu, stopwatch: &Stopwatch, live: &mut Live, scene: &Scene) -> StarLight {
    live.show(scene, Show::Picture);
    stopwatch.submit(gpu, live);
    let since = Instant::now();
    loop {
        gpu.poll().unwrap();
        if let Some(light) = live.star_light() {
            return light;
        }
        assert!(live.awaits_star_light(), "nothing is on its way");
        assert!(since.elapsed() < Duration::from_secs(60), "no word comes");
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn a_live_picture_tells_whether_it_has_the_light_of_all_stars() {
    let gpu = gpu();
    let scene = scene();
    let stopwatch = Stopwatch::new(&gpu);
    let mut live = live(&gpu, &scene, Some(0.0));
    for _ in 0..10 {
        let light = report(&gpu, &stopwatch, &mut live, &scene);
        assert_eq!(light, StarLight::Whole);
        assert!(!live.awaits_star_light(), "all have come back");
    }
    // So bright that each has halos: more than two million places of lists.
    live.set_stars(field(Some(12.0)).as_ref());
    for _ in 0..2 {
        let light = report(&gpu, &stopwatch, &mut live, &scene);
        assert_eq!(light, StarLight::PartLost);
    }
    live.set_stars(field(Some(0.0)).as_ref());
    let light = report(&gpu, &stopwatch, &mut live, &scene);
    assert_eq!(light, StarLight::Whole);
}

/// A window draws on without asking, and asks when it likes.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn frames_that_nobody_asks_about_do_no_harm() {
    let gpu = gpu();
    let scene = scene();
    let stopwatch = Stopwatch::new(&gpu);
    let mut live = live(&gpu, &scene, Some(12.0));
    for _ in 0..6 {
        live.show(&scene, Show::Picture);
        stopwatch.submit(&gpu, &live);
    }
    gpu.wait().unwrap();
    let light = report(&gpu, &stopwatch, &mut live, &scene);
    assert_eq!(light, StarLight::PartLost);
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn without_stars_there_is_nothing_to_tell() {
    let gpu = gpu();
    let scene = scene();
    let mut live = live(&gpu, &scene, None);
    live.show(&scene, Show::Picture);
    Stopwatch::new(&gpu).submit(&gpu, &live);
    assert_eq!(live.star_light(), None);
    assert!(!live.awaits_star_light());
}
