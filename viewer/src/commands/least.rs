//! Choice of the least model, the cheapest within an error budget, for `render` and `diff`.

use super::CommandError;
use lensbake_program::{Printer, message};
use lensbake_render::disc::Disc;
use lensbake_render::gpu::Gpu;
use lensbake_render::lens::Lens;
use lensbake_render::model::{Choice, Precision, choose, explain};
use std::time::Instant;

/// Chooses the least model for the sky and `disc` through `lens` at the precision of the GPU (f32), or of the CPU (f64) without one.
pub fn choice(
    lens: &Lens,
    disc: Option<Disc>,
    budget_px: f64,
    gpu: Option<&Gpu>,
) -> Result<Choice, CommandError> {
    let precision = match gpu {
        Some(_) => Precision::F32,
        None => Precision::F64,
    };
    let started = Instant::now();
    let choice =
        choose(lens, disc, budget_px, precision).map_err(|problem| CommandError::Lens {
            name: "the least model".into(),
            problem,
        })?;
    let ms = 1e3 * started.elapsed().as_secs_f64();
    message!("least model chosen in {ms:.1} ms");
    Ok(choice)
}

/// Prints the explanation of `choice`.
pub fn print(choice: &Choice, lens: &Lens, step: f64, printer: &mut Printer) {
    printer.print(&explain(choice, lens, step));
}

/// The lens of the chosen model. If no model keeps the budget, prints a warning and returns the lens of the whole
/// row.
pub fn lens_of(choice: Choice, whole: &Lens) -> Lens {
    match choice.chosen {
        Some(candidate) => candidate.lens,
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

/// Refuses a budget that is not positive and finite.
pub fn check_budget(budget_px: f64) -> Result<(), CommandError> {
    if budget_px > 0.0 && budget_px.is_finite() {
        Ok(())
    } else {
        Err(CommandError::Budget(budget_px))
    }
}
