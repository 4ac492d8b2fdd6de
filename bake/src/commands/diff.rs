//! `bake diff`: a table against the direct integrator and against the closed form.

use super::{CommandError, table_or_atlas, write_file};
use crate::cli::DiffArgs;
use bake::diff::{Comparison, Diff, DiffStatistics, Picture, diff};
use bake::{plot, rays};
use lensbake_report::{Outcome, Progress};
use std::io::{self, Write};

pub fn run(args: &DiffArgs) -> Result<Outcome, CommandError> {
    let (table, name) = table_or_atlas(args.file.as_deref())?;
    let sights = rays::random(table.header(), args.rays as usize, args.seed);
    let progress = Progress::new("comparing", args.rays.into());
    let diff = diff(&table, &sights, args.tolerance, || progress.step()).map_err(|problem| {
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
    if let Some(path) = &args.csv {
        let mut csv = Vec::new();
        diff.write_csv(&picture, &mut csv)
            .map_err(CommandError::Stdout)?;
        write_file(path, &csv)?;
    }
    if let Some(path) = &args.plot {
        let title = format!(
            "{}: error along the row, {} rays",
            name.display(),
            args.rays
        );
        let svg =
            plot::error_figure(&diff, args.budget, &title).map_err(|e| CommandError::File {
                path: path.clone(),
                problem: e.to_string(),
            })?;
        write_file(path, svg.as_bytes())?;
    }
    report(&diff, &picture, args, &name.display().to_string())
}

/// One of the differences that are reported.
type Difference = (&'static str, fn(&Comparison) -> f64);

const DIFFERENCES: [Difference; 3] = [
    ("table - closed form", |ray| ray.lookup - ray.closed),
    ("table - direct", |ray| ray.lookup - ray.direct),
    ("direct - closed form", |ray| ray.direct - ray.closed),
];

fn report(
    diff: &Diff,
    picture: &Picture,
    args: &DiffArgs,
    name: &str,
) -> Result<Outcome, CommandError> {
    let mut text = format!(
        "{name}: {} rays, 1 - x from {:.0e}; pixels of a picture {} wide and {} degrees across\n",
        diff.rays.len(),
        rays::EDGE_GAP,
        args.width,
        args.fov,
    );
    let mut missed = false;
    for (index, (what, error)) in DIFFERENCES.into_iter().enumerate() {
        let Some(DiffStatistics { radians, pixels }) = diff.statistics(picture, error) else {
            continue;
        };
        text += &format!("{what:21} rad  {radians}\n");
        match pixels {
            Some(pixels) => text += &format!("{:21} px   {pixels}\n", ""),
            None => {
                text += &format!(
                    "{:21} px   none: the observer at infinity has no picture\n",
                    ""
                )
            }
        }
        if index == 0 {
            missed = radians.max > args.budget || pixels.is_some_and(|p| p.max > args.budget_px);
        }
    }
    io::stdout()
        .write_all(text.as_bytes())
        .map_err(CommandError::Stdout)?;
    if missed {
        eprintln!(
            "bake: {name}: the error against the closed form is above the budget of {:e} rad or {} px",
            args.budget, args.budget_px
        );
        return Ok(Outcome::Missed);
    }
    Ok(Outcome::Done)
}
