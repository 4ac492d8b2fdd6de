//! The least model over random scenes: the chosen model keeps the budget when drawn, and cheaper models exceed it.

use glam::DVec3;
use lensbake_core::RayOutcome;
use lensbake_render::camera::{Camera, View};
use lensbake_render::cpu;
use lensbake_render::diff::{PixelError, Reference};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::model::{Candidate, Choice, Model, Precision, choose};
use lensbake_tables::default_atlas;
use lensbake_tests::{renderer, trace_on_gpu};

/// `count` random scenes and budgets, of all kinds in turn.
fn scenes(count: usize, seed: u64, size: (u32, u32)) -> Vec<(Lens, f64)> {
    let mut random = fastrand::Rng::with_seed(seed);
    (0..count)
        .map(|index| {
            let view = view(&mut random, index, size);
            let budget_px = decades(&mut random, -3.0, 0.0);
            let camera = Camera::new(&view).unwrap();
            (
                Lens::new(camera, default_atlas(), Deflection::Lut).unwrap(),
                budget_px,
            )
        })
        .collect()
}

/// 10ⁿ with n uniform from `from` to `to`.
fn decades(random: &mut fastrand::Rng, from: f64, to: f64) -> f64 {
    10f64.powf(from + (to - from) * random.f64())
}

/// A random view: from near or far; at the hole, at the shadow's edge, anywhere or straight away from the hole;
/// wide or narrow.
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
    .shadow_angle()
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
fn measured(reference: &Reference, lens: &Lens) -> f64 {
    let trace = cpu::trace(lens, || ());
    largest(reference, &trace)
}

fn largest(reference: &Reference, trace: &[RayOutcome<DVec3>]) -> f64 {
    let errors = reference.errors(trace, &reference.trace());
    // `total_cmp` makes NaN the largest error, so that it is not lost.
    let pixels = errors.iter().map(PixelError::pixels);
    pixels.max_by(f64::total_cmp).unwrap_or(0.0)
}

/// Draws with the chosen model and with the cheaper ones; checks that only the chosen one keeps the budget.
/// `slack` is the part by which a prediction from samples may miss the worst pixel of a picture.
fn check_budget(index: usize, lens: &Lens, choice: &Choice, slack: f64) {
    let reference = Reference::new(lens, || ());
    let at = || format!("scene {index}, {} px: {:?}", choice.budget_px, lens.camera);
    let held = |candidate: &Candidate| {
        let (measured, predicted) = (
            measured(&reference, &candidate.lens),
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
    for (index, (lens, budget_px)) in scenes.iter().enumerate() {
        let choice = choose(lens, None, *budget_px, Precision::F64).unwrap();
        check_budget(index, lens, &choice, 0.0);
        chosen.push(choice.chosen.map(|candidate| candidate.model));
    }
    // The test only has a meaning if the scenes need different models.
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
    for (index, (lens, budget_px)) in scenes(36, 7, (640, 360)).iter().enumerate() {
        let choice = choose(lens, None, *budget_px, Precision::F64).unwrap();
        assert!(choice.samples < lens.camera.pixels() / 10);
        check_budget(index, lens, &choice, 0.01);
    }
}

#[test]
fn the_choice_is_always_the_same() {
    for (lens, budget_px) in scenes(12, 3, (640, 360)) {
        let again = || choose(&lens, None, budget_px, Precision::F64).unwrap();
        assert_eq!(again(), again());
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn pictures_on_the_gpu_keep_their_budget_too() {
    let renderer = renderer();
    let mut met = 0;
    for (index, (lens, budget_px)) in scenes(108, 11, (64, 36)).iter().enumerate() {
        let choice = choose(lens, None, *budget_px, Precision::F32).unwrap();
        let Some(chosen) = choice.chosen else {
            continue;
        };
        let trace = trace_on_gpu(&renderer, &chosen.lens);
        let error = largest(&Reference::new(lens, || ()), &trace);
        assert!(
            error <= *budget_px,
            "scene {index}, {}: {error} px of {budget_px}: {:?} {:?}",
            chosen.model,
            lens.camera,
            chosen.prediction
        );
        met += 1;
    }
    assert!(met >= 60, "{met}");
}
