//! The least model over random scenes: what is chosen keeps its budget as drawn, and what is cheaper
//! would break it as drawn.

use glam::DVec3;
use lensbake_core::Fate;
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use viewer::camera::{Camera, View};
use viewer::cpu;
use viewer::diff::{PixelError, Reference};
use viewer::gpu::Renderer;
use viewer::model::{Candidate, Choice, Model, Precision, choose};
use viewer::scene::{Method, Scene};
use viewer::sky::{Sky, SkySource};

/// A random choice of `count` scenes and budgets, of all kinds in turn.
fn scenes(count: usize, seed: u64, size: (u32, u32)) -> Vec<(Scene, f64)> {
    let mut random = fastrand::Rng::with_seed(seed);
    (0..count)
        .map(|index| {
            let view = view(&mut random, index, size);
            let budget_px = decades(&mut random, -3.0, 0.0);
            let camera = Camera::new(&view).unwrap();
            (
                Scene::new(camera, default_atlas(), Method::Lut).unwrap(),
                budget_px,
            )
        })
        .collect()
}

/// 10ⁿ with n drawn evenly.
fn decades(random: &mut fastrand::Rng, from: f64, to: f64) -> f64 {
    10f64.powf(from + (to - from) * random.f64())
}

/// A view far away or near, at the hole, at its edge, anywhere or straight away from it, wide or narrow.
fn view(random: &mut fastrand::Rng, index: usize, (width, height): (u32, u32)) -> View {
    let radius = match index % 3 {
        0 => 1.0 + decades(random, -1.3, 0.5),
        1 => decades(random, 0.5, 2.0),
        _ => decades(random, 2.0, 6.0),
    };
    let edge_deg = Camera::new(&View {
        radius,
        ..View::default()
    })
    .unwrap()
    .observer
    .edge_angle()
    .to_degrees();
    let yaw_deg = match index / 3 % 4 {
        0 => 0.0,
        1 => edge_deg * (0.9 + 0.2 * random.f64()),
        2 => 360.0 * random.f64(),
        _ => 180.0,
    };
    let fov_deg = match index / 12 % 3 {
        0 => 20.0 + 100.0 * random.f64(),
        1 => 120.0 + 55.0 * random.f64(),
        _ => decades(random, -0.5, 1.3),
    };
    View {
        radius,
        yaw_deg,
        pitch_deg: 20.0 * (random.f64() - 0.5),
        roll_deg: 360.0 * random.f64(),
        fov_deg,
        width,
        height,
        ..View::default()
    }
}

/// The largest error of the CPU's whole picture, pixels.
fn measured(reference: &Reference, scene: &Scene) -> f64 {
    let trace = cpu::trace(scene, || ());
    largest(reference, &trace)
}

fn largest(reference: &Reference, trace: &[Fate<DVec3>]) -> f64 {
    let errors = reference.errors(trace, &reference.trace());
    // A NaN is the largest of all, not lost.
    let pixels = errors.iter().map(PixelError::pixels);
    pixels.max_by(f64::total_cmp).unwrap_or(0.0)
}

/// Draws what was chosen and what is next cheaper, and holds both to the budget. `slack` is by how much
/// a prediction from samples may miss the worst pixel of a picture.
fn hold_to_budget(index: usize, scene: &Scene, choice: &Choice, slack: f64) {
    let reference = Reference::new(scene, || ());
    let at = || format!("scene {index}, {} px: {:?}", choice.budget_px, scene.camera);
    let held = |candidate: &Candidate| {
        let (measured, predicted) = (
            measured(&reference, &candidate.scene),
            candidate.prediction.pixels,
        );
        assert!(
            measured <= predicted * (1.0 + slack),
            "{}: {measured} > {predicted}",
            at()
        );
        assert!(
            measured >= predicted * (1.0 - 1e-9),
            "{}: {measured} < {predicted}",
            at()
        );
        measured
    };
    if let Some(chosen) = &choice.chosen {
        assert!(held(chosen) <= choice.budget_px * (1.0 + slack), "{}", at());
    }
    for candidate in &choice.left_out {
        assert!(
            held(candidate) > choice.budget_px,
            "{}: {}",
            at(),
            candidate.model
        );
    }
}

#[test]
fn small_pictures_keep_their_budget_and_cheaper_models_would_not() {
    let scenes = scenes(360, 20_220_501, (64, 36));
    assert_eq!(scenes.len(), 360);
    let mut chosen = Vec::new();
    for (index, (scene, budget_px)) in scenes.iter().enumerate() {
        let choice = choose(scene, *budget_px, Precision::F64).unwrap();
        hold_to_budget(index, scene, &choice, 0.0);
        chosen.push(choice.chosen.map(|candidate| candidate.model));
    }
    // The random scenes are only worth something if they ask for different models.
    let flat = chosen.iter().filter(|m| **m == Some(Model::Flat)).count();
    let met = chosen.iter().flatten().count();
    println!("chosen: {:?}", tally(&chosen));
    assert!(
        flat >= 20 && met >= 300 && tally(&chosen).len() >= 6,
        "{:?}",
        tally(&chosen)
    );
}

fn tally(chosen: &[Option<Model>]) -> Vec<(String, usize)> {
    let name = |m: &Option<Model>| m.map_or("none".to_owned(), |m| m.to_string());
    let mut names: Vec<_> = chosen.iter().map(name).collect();
    names.sort();
    names
        .chunk_by(|a, b| a == b)
        .map(|same| (same[0].clone(), same.len()))
        .collect()
}

#[test]
fn large_pictures_are_judged_by_few_of_their_pixels() {
    for (index, (scene, budget_px)) in scenes(36, 7, (640, 360)).iter().enumerate() {
        let choice = choose(scene, *budget_px, Precision::F64).unwrap();
        assert!(choice.samples < scene.camera.pixels() / 10);
        hold_to_budget(index, scene, &choice, 0.01);
    }
}

#[test]
fn the_choice_is_always_the_same() {
    for (scene, budget_px) in scenes(12, 3, (640, 360)) {
        let again = || choose(&scene, budget_px, Precision::F64).unwrap();
        assert_eq!(again(), again());
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn pictures_on_the_gpu_keep_their_budget_too() {
    let gpu = gpu();
    let sky = viewer::sky::load(&SkySource::Grid).unwrap();
    let renderer = renderer(&gpu, &sky);
    let mut met = 0;
    for (index, (scene, budget_px)) in scenes(108, 11, (64, 36)).iter().enumerate() {
        let choice = choose(scene, *budget_px, Precision::F32).unwrap();
        let Some(chosen) = choice.chosen else {
            continue;
        };
        let trace = renderer.trace(&chosen.scene, |_| ()).unwrap();
        let error = largest(&Reference::new(scene, || ()), &trace);
        assert!(
            error <= *budget_px,
            "scene {index}, {}: {error} px of {budget_px}: {:?} {:?}",
            chosen.model,
            scene.camera,
            chosen.prediction
        );
        met += 1;
    }
    assert!(met >= 60, "{met}");
}

fn renderer(gpu: &viewer::gpu::Gpu, sky: &Sky) -> Renderer {
    Renderer::new(gpu, sky).unwrap()
}
