//! The choice of a model as text: what was chosen, what was left out, and why.

use super::{Candidate, Choice, Cost, Model, Precision};
use crate::gpu::DISC_BYTES;
use crate::lens::{Deflection, Lens};

/// The choice as a text table. `lens` is the lens of the choice, and `step` (rad) that of the direct integration
/// that is listed as not asked for.
pub fn explain(choice: &Choice, lens: &Lens, step: f64) -> String {
    let mut text = heading(choice, lens);
    for candidate in &choice.left_out {
        text += &tried("left out", candidate);
    }
    match &choice.chosen {
        Some(candidate) => text += &tried("chosen", candidate),
        None => text += &line("none", "", "the whole row breaks the budget too", ""),
    }
    if let (Some(first), Some(last)) = (choice.not_needed.first(), choice.not_needed.last()) {
        let models = format!("{first} … {last}");
        text += &line("not needed", "more expensive:", &models, "");
    }
    let direct = Model::Direct { step };
    let cost = Cost::of(&lens.with_deflection(Deflection::Direct { step }));
    text + &line(
        "not asked",
        &direct.to_string(),
        "drawn only with --method direct",
        &cost.to_string(),
    )
}

fn heading(choice: &Choice, lens: &Lens) -> String {
    let camera = &lens.camera;
    let numbers = match choice.precision {
        Precision::F32 => "f32",
        Precision::F64 => "f64",
    };
    format!(
        "least model within {} px of {} x {} pixels, judged at {} of {}; {numbers} rounds to {} px\n",
        choice.budget_px,
        camera.width,
        camera.height,
        choice.samples,
        camera.pixels(),
        two_digits(choice.rounding_px),
    ) + &line(
        "",
        "model",
        "largest error, at pixel",
        "cost of the bending",
    ) + &disc(choice)
}

/// What a disc adds, if there is one.
fn disc(choice: &Choice) -> String {
    let Some(samples) = choice.samples_of_disc else {
        return String::new();
    };
    line(
        "with disc",
        "in every model",
        &format!("shown at {samples} of these pixels"),
        &format!("{DISC_BYTES:5} bytes per frame more, and the orbit of each ray that may meet it"),
    )
}

fn tried(verdict: &str, candidate: &Candidate) -> String {
    let prediction = &candidate.prediction;
    let radians = match prediction.radians {
        Some(_) if prediction.on_disc => "on the disc".to_owned(),
        Some(radians) => format!("{radians:.1e} rad"),
        None => "other outcome".to_owned(),
    };
    let (column, row) = prediction.worst;
    let error = format!(
        "{:>7} px, {radians:10} ({column}, {row})",
        two_digits(prediction.pixels)
    );
    let cost = Cost::of(&candidate.lens).to_string();
    line(verdict, &candidate.model.to_string(), &error, &cost)
}

fn line(verdict: &str, model: &str, error: &str, cost: &str) -> String {
    let line = format!("{verdict:11}{model:20}{error:37}{cost}");
    line.trim_end().to_owned() + "\n"
}

/// A non-negative number with two significant digits, written out unless it is tiny or huge.
fn two_digits(value: f64) -> String {
    if value == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&value) {
        let decimals = (1.0 - value.log10().floor()).max(0.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.1e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::disc::Disc;
    use crate::model::choose;
    use lensbake_tables::default_atlas;

    #[test]
    fn numbers_are_written_for_people() {
        let written = [0.0, 184.2, 6.54, 0.0331, 1e-5, 3e7].map(two_digits);
        assert_eq!(written, ["0", "184", "6.5", "0.033", "1.0e-5", "3.0e7"]);
    }

    #[test]
    fn every_model_has_its_line() {
        let camera = Camera::new(&View {
            width: 64,
            height: 36,
            ..View::default()
        });
        let lens = Lens::new(camera.unwrap(), default_atlas(), Deflection::Lut).unwrap();
        for (budget_px, disc) in [(0.1, None), (1e-9, None), (0.1, Some(Disc::default()))] {
            let choice = choose(&lens, disc, budget_px, Precision::F64).unwrap();
            let text = explain(&choice, &lens, 0.05);
            let lines = |verdict| text.lines().filter(|l| l.starts_with(verdict)).count();
            assert_eq!(lines("left out"), choice.left_out.len(), "{text}");
            assert_eq!(lines("chosen"), usize::from(choice.chosen.is_some()));
            assert_eq!(lines("none"), usize::from(choice.chosen.is_none()));
            assert_eq!(lines("not asked"), 1);
            assert_eq!(lines("with disc"), usize::from(disc.is_some()));
        }
    }
}
