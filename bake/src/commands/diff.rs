//! `bake diff`: compares a table with the direct integrator and with the closed form.

use super::{CommandError, table_or_atlas};
use crate::cli::DiffArgs;
use lensbake_core::Motion;
use lensbake_program::output::Output;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_studies::figure::drawing::DrawError;
use lensbake_studies::table_error::figure::{Curve, error_figure};
use lensbake_studies::table_error::{Comparison, Diff, DiffStatistics, Picture, Zone, diff};
use lensbake_tables::baking;
use std::path::PathBuf;

pub fn run(args: &DiffArgs) -> Result<Outcome, CommandError> {
    let outputs = Outputs::new(args)?;
    let (table, name) = table_or_atlas(args.file.as_deref())?;
    let motion = args.motion;
    let rays = baking::random_in_motion(table.header(), motion, args.rays as usize, args.seed)
        .map_err(|problem| CommandError::Motion { motion, problem })?;
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
    let csv = outputs.write_csv(&diff, &picture, motion);
    let parts = Part::of(diff, args);
    let plot = outputs.write_plot(&parts, &title(&name, args));
    let mut printer = Printer::new(outputs.take_standard_output());
    let outcome = report(&parts, &picture, args, &name, &mut printer);
    csv.and(plot)?;
    printer.finish()?;
    Ok(outcome)
}

/// Rays whose errors are stated together, and their budgets.
struct Part {
    /// The radii; `None` for all observers at rest.
    zone: Option<Zone>,
    diff: Diff,
    /// rad
    budget: f64,
    /// Pixels; `None` if there is no such budget.
    budget_px: Option<f64>,
}

impl Part {
    /// The parts of `diff`: one for observers at rest, else one for each [`Zone`].
    fn of(diff: Diff, args: &DiffArgs) -> Vec<Self> {
        let part = |zone, diff| {
            let (budget, budget_px) = match zone {
                Some(Zone::Deep) => (args.budget_deep, None),
                _ => (args.budget, Some(args.budget_px)),
            };
            Part {
                zone,
                diff,
                budget,
                budget_px,
            }
        };
        if args.motion == Motion::Rest {
            return vec![part(None, diff)];
        }
        let zones = diff.by_zone().into_iter();
        zones.map(|(zone, diff)| part(Some(zone), diff)).collect()
    }
}

fn title(name: &str, args: &DiffArgs) -> String {
    let motion = match args.motion {
        Motion::Rest => String::new(),
        motion => format!(", motion {motion}"),
    };
    format!("{name}{motion}: error along the row, {} rays", args.rays)
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

    fn write_csv(
        &self,
        diff: &Diff,
        picture: &Picture,
        motion: Motion,
    ) -> Result<(), CommandError> {
        match &self.csv {
            Some(file) => Ok(file.write(diff.csv(picture, motion).as_bytes())?),
            None => Ok(()),
        }
    }

    fn write_plot(&self, parts: &[Part], title: &str) -> Result<(), CommandError> {
        let Some(file) = &self.plot else {
            return Ok(());
        };
        let curves: Vec<Curve> = parts
            .iter()
            .map(|part| Curve {
                name: match part.zone {
                    None => "lookup − closed form".to_owned(),
                    Some(zone) => format!("lookup − closed form, {}", zone.name()),
                },
                diff: &part.diff,
                budget: part.budget,
            })
            .collect();
        let svg = error_figure(&curves, title).map_err(DrawError::from)?;
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

/// Prints the differences; [`Outcome::Done`] if the errors of all parts against the closed form are within their
/// budgets.
fn report(
    parts: &[Part],
    picture: &Picture,
    args: &DiffArgs,
    name: &str,
    printer: &mut Printer,
) -> Outcome {
    let motion = match args.motion {
        Motion::Rest => String::new(),
        motion => format!(" of observers in motion ({motion})"),
    };
    printer.print(&format!(
        "{name}: {} rays{motion}, 1 - x from {:.0e}; pixels of a picture {} wide and {} degrees across\n",
        args.rays,
        baking::EDGE_GAP,
        args.width,
        args.fov,
    ));
    let mut outcome = Outcome::Done;
    for part in parts {
        let (text, is_within_budget) = report_part(part, picture);
        printer.print(&text);
        if !is_within_budget {
            message!("bake: {name}: {}", missed(part));
            outcome = Outcome::Missed;
        }
    }
    outcome
}

/// The text on one part, and whether its error against the closed form is within the budget.
fn report_part(part: &Part, picture: &Picture) -> (String, bool) {
    let mut text = match part.zone {
        None => String::new(),
        Some(zone) => format!("{}: {} rays\n", zone.name(), part.diff.rays.len()),
    };
    let mut is_within_budget = false;
    for (index, (what, error)) in DIFFERENCES.into_iter().enumerate() {
        let Some(DiffStatistics { radians, pixels }) = part.diff.statistics(picture, error) else {
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
            let largest_px = pixels.map_or(0.0, |pixels| pixels.max);
            is_within_budget = radians.max <= part.budget
                && part.budget_px.is_none_or(|budget| largest_px <= budget);
        }
    }
    (text, is_within_budget)
}

/// What to say of a part whose error is above its budget.
fn missed(part: &Part) -> String {
    let place = part
        .zone
        .map_or(String::new(), |zone| format!(" for {}", zone.name()));
    let pixels = part
        .budget_px
        .map_or(String::new(), |budget| format!(" or {budget} px"));
    format!(
        "the error against the closed form{place} is above the budget of {:e} rad{pixels}",
        part.budget
    )
}
