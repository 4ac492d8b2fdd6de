//! `bake chart`: speed against accuracy.

use super::{CommandError, make_directory, write_figure, write_file};
use crate::cli::ChartArgs;
use bake::chart::figure::{ChartFigure, Unit};
use bake::chart::{Effort, Entry, Section, csv, measure, pareto, steps};
use lensbake_report::{Outcome, Progress};
use std::io::{self, Write};

pub fn run(args: &ChartArgs) -> Result<Outcome, CommandError> {
    make_directory(&args.output)?;
    let effort = effort(args);
    let progress = Progress::new("measuring", steps(&effort));
    let sections = measure(&effort, || progress.step())?;
    let elapsed = progress.finish();
    write_file(
        &args.output.join("chart.csv"),
        csv::text(&sections).as_bytes(),
    )?;
    for (name, unit) in [("chart-rad", Unit::Radians), ("chart-px", Unit::Pixels)] {
        let figure = ChartFigure {
            sections: &sections,
            unit,
        };
        write_figure(&args.output.join(name), &figure)?;
    }
    eprintln!(
        "measured in {:.0} s, wrote {}",
        elapsed.as_secs_f64(),
        args.output.display()
    );
    report(&sections)
}

fn effort(args: &ChartArgs) -> Effort {
    if args.quick {
        Effort {
            rays: 500,
            timed_rays: 100,
            rounds: 3,
            batch_us: 50,
            seed: args.seed,
        }
    } else {
        Effort {
            rays: 20_000,
            timed_rays: 1_000,
            rounds: 9,
            batch_us: 1_000,
            seed: args.seed,
        }
    }
}

/// Prints the Pareto front of the far observer's methods, and whether the claim holds.
fn report(sections: &[Section]) -> Result<Outcome, CommandError> {
    let Some(far) = sections.first() else {
        return Ok(Outcome::Done);
    };
    let mut text = String::from("      ns   largest error, rad        px   bytes   method\n");
    for index in pareto::front(&far.entries, |entry| entry.radians.max) {
        text += &line(&far.entries[index]);
    }
    text += &format!(
        "noise of this run: {:.1} % of a time\n",
        100.0 * far.noise()
    );
    let better = pareto::better_than_default(far);
    for entry in &better {
        text += &format!("better than the default row:\n{}", line(entry));
    }
    io::stdout()
        .write_all(text.as_bytes())
        .map_err(CommandError::Stdout)?;
    if better.is_empty() {
        Ok(Outcome::Done)
    } else {
        eprintln!("bake: a method beats the default row");
        Ok(Outcome::Missed)
    }
}

fn line(entry: &Entry) -> String {
    format!(
        "{:8.1}   {:18.2e}  {:8.1e}  {:6}   {}\n",
        entry.ns,
        entry.radians.max,
        entry.pixels.max,
        entry.bytes,
        entry.card.label(),
    )
}
