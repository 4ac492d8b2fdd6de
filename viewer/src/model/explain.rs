//! A choice in words: what was chosen, what was left out, and why.

use super::{Candidate, Choice, Cost, Model, Precision};
use crate::scene::{Method, Scene};

/// The choice as a table for people; `scene` is the one it was made for, `step` (rad) that of the
/// direct integration that was not asked for.
pub fn explain(choice: &Choice, scene: &Scene, step: f64) -> String {
    let camera = &scene.camera;
    let numbers = match choice.precision {
        Precision::F32 => "f32",
        Precision::F64 => "f64",
    };
    let mut text = format!(
        "least model within {} px of {} x {} pixels, judged at {} of {}; {numbers} rounds to {:.1e} px\n",
        choice.budget_px,
        camera.width,
        camera.height,
        choice.samples,
        camera.pixels(),
        choice.rounding_px,
    );
    for candidate in &choice.left_out {
        text += &tried("left out", candidate);
    }
    match &choice.chosen {
        Some(candidate) => text += &tried("chosen", candidate),
        None => text += "none       the whole row does not keep the budget either\n",
    }
    if let (Some(first), Some(last)) = (choice.not_needed.first(), choice.not_needed.last()) {
        text += &format!("{:11}{first} … {last}: dearer\n", "not needed");
    }
    let direct = Model::Direct { step };
    let cost = Cost::of(&scene.by(Method::Direct { step }));
    text += &format!(
        "{:11}{direct:20}{:45}{cost}\n",
        "not asked", "drawn only with --method direct"
    );
    text
}

fn tried(verdict: &str, candidate: &Candidate) -> String {
    let prediction = &candidate.prediction;
    let radians = match prediction.radians {
        Some(radians) => format!("{radians:.1e} rad"),
        None => "other fate".to_owned(),
    };
    let (column, row) = prediction.worst;
    format!(
        "{verdict:11}{:20}{:.1e} px, {radians:11} at {:13} {}\n",
        candidate.model,
        prediction.pixels,
        format!("({column}, {row})"),
        Cost::of(&candidate.scene)
    )
}
