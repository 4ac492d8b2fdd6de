//! The least model, as the commands ask for it.

use super::CommandError;
use lensbake_report::{Printer, message};
use std::time::Instant;
use viewer::gpu::Gpu;
use viewer::model::{Choice, Precision, choose, explain};
use viewer::scene::Scene;

/// The choice for `scene` on the GPU, or on the CPU without one.
pub fn choice(scene: &Scene, budget_px: f64, gpu: Option<&Gpu>) -> Result<Choice, CommandError> {
    let precision = match gpu {
        Some(_) => Precision::F32,
        None => Precision::F64,
    };
    let started = Instant::now();
    let choice = choose(scene, budget_px, precision).map_err(|problem| CommandError::Scene {
        name: "the least model".into(),
        problem,
    })?;
    let ms = 1e3 * started.elapsed().as_secs_f64();
    message!("least model chosen in {ms:.1} ms");
    Ok(choice)
}

/// Explains `choice`.
pub fn print(choice: &Choice, scene: &Scene, step: f64, printer: &mut Printer) {
    printer.print(&explain(choice, scene, step));
}

/// The scene to draw: by the chosen model, or with a line of warning by the whole row.
pub fn scene_of(choice: Choice, whole: &Scene) -> Scene {
    match choice.chosen {
        Some(candidate) => candidate.scene,
        None => {
            let advice = if choice.rounding_px > choice.budget_px {
                " (f32 rounding alone breaks it: try --device cpu)"
            } else {
                ""
            };
            message!(
                "viewer: no model keeps the error within {} px here{advice}; drawing with the whole row",
                choice.budget_px
            );
            whole.clone()
        }
    }
}

/// Refuses a budget that is none.
pub fn check_budget(budget_px: f64) -> Result<(), CommandError> {
    if budget_px > 0.0 && budget_px.is_finite() {
        Ok(())
    } else {
        Err(CommandError::Budget(budget_px))
    }
}
