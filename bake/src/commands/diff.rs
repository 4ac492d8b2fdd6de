//! `bake diff`: compares a table with the direct integrator and with the closed form.

use super::{CommandError, table_or_atlas};
use crate::cli::DiffArgs;
use lensbake_program::output::Output;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_studies::figure::drawing::DrawError;
use lensbake_studies::table_error::{Comparison, Diff, DiffStatistics, Picture, diff, figure};
use lensbake_tables::baking;
use std::path::PathBuf;

pub fn run(args: &DiffArgs) -> Result<Outcome, CommandError> {
    let outputs = Outputs::new(args)?;
    let (table, name) = table_or_atlas(args.file.as_deref())?;
    let rays = baking::random(table.header(), args.rays as usize, args.seed);
    let progress = Progress::new("comparing", args.rays.into());
    let diff = diff(&table, &rays, args.tolerance, || progress.step()).map_err(|problem| {
        CommandError::InTable {
            path: name.clone(),
            problem,
        }
    })?;
    progress.finish();
    let picture = Picture {
        width: args.width,
        field_of_view: args.fov.to_radians(),
    };
    let name = name.display().to_string();
    // Write the files and the report even if one of them fails; the error follows afterwards.
    let csv = outputs.write_csv(&diff, &picture);
    let plot = outputs.write_plot(&diff, args.budget, &name);
    let mut printer = Printer::new(outputs.take_standard_output());
    let outcome = report(&diff, &picture, args, &name, &mut printer);
    csv.and(plot)?;
    printer.finish()?;
    Ok(outcome)
}

/// The files that are written besides the report.
struct Outputs {
    csv: Option<Output>,
    plot: Option<Output>,
}

impl Outputs {
    fn new(args: &DiffArgs) -> Result<Self, CommandError> {
        let output = |path: &Option<PathBuf>| path.as_deref().map(Output::new).transpose();
        let outputs = Outputs {
            csv: output(&args.csv)?,
            plot: output(&args.plot)?,
        };
        if let (Some(csv), Some(plot)) = (&outputs.csv, &outputs.plot) {
            csv.is_apart(plot, ["--csv", "--plot"])?;
        }
        if let Some(table) = &args.file {
            for output in [&outputs.csv, &outputs.plot].into_iter().flatten() {
                output.spares(table)?;
            }
        }
        Ok(outputs)
    }

    fn take_standard_output(&self) -> bool {
        let outputs = [&self.csv, &self.plot].into_iter().flatten();
        outputs.into_iter().any(Output::is_standard_output)
    }

    fn write_csv(&self, diff: &Diff, picture: &Picture) -> Result<(), CommandError> {
        match &self.csv {
            Some(file) => Ok(file.write(diff.csv(picture).as_bytes())?),
            None => Ok(()),
        }
    }

    fn write_plot(&self, diff: &Diff, budget: f64, name: &str) -> Result<(), CommandError> {
        let Some(file) = &self.plot else {
            return Ok(());
        };
        let title = format!("{name}: error along the row, {} rays", diff.rays.len());
        let svg = figure::error_figure(diff, budget, &title).map_err(DrawError::from)?;
        Ok(file.write(svg.as_bytes())?)
    }
}

/// The name of a reported difference, and the function that computes it.
type Difference = (&'static str, fn(&Comparison) -> f64);

const DIFFERENCES: [Difference; 3] = [
    ("table - closed form", |ray| ray.lookup - ray.closed),
    ("table - direct", |ray| ray.lookup - ray.direct),
    ("direct - closed form", |ray| ray.direct - ray.closed),
];

/// Prints the differences; [`Outcome::Done`] if the error against the closed form is within the budget.
fn report(
    diff: &Diff,
    picture: &Picture,
    args: &DiffArgs,
    name: &str,
    printer: &mut Printer,
) -> Outcome {
    let mut text = format!(
        "{name}: {} rays, 1 - x from {:.0e}; pixels of a picture {} wide and {} degrees across\n",
        diff.rays.len(),
        baking::EDGE_GAP,
        args.width,
        args.fov,
    );
    let mut within_budget = false;
    for (index, (what, error)) in DIFFERENCES.into_iter().enumerate() {
        let Some(DiffStatistics { radians, pixels }) = diff.statistics(picture, error) else {
            continue;
        };
        text += &format!("{what:21} rad  {radians}\n");
        text += &match pixels {
            Some(pixels) => format!("{:21} px   {pixels}\n", ""),
            None => format!(
                "{:21} px   none: the observer at infinity has no picture\n",
                ""
            ),
        };
        if index == 0 {
            within_budget =
                radians.max <= args.budget && pixels.is_none_or(|p| p.max <= args.budget_px);
        }
    }
    printer.print(&text);
    if within_budget {
        return Outcome::Done;
    }
    message!(
        "bake: {name}: the error against the closed form is above the budget of {:e} rad or {} px",
        args.budget,
        args.budget_px
    );
    Outcome::Missed
}
