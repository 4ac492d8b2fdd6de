//! `bake chart`: speed against accuracy.

use super::{CommandError, FigureFiles};
use crate::cli::ChartArgs;
use bake::chart::figure::{ChartFigure, Unit};
use bake::chart::{Effort, Entry, Section, csv, measure, pareto, steps};
use lensbake_report::{Outcome, Printer, Progress, message};
use lensbake_tables::output::OutputFolder;

pub fn run(args: &ChartArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let table = folder.file("chart.csv")?;
    let figures = [
        (FigureFiles::new(&folder, "chart-rad")?, Unit::Radians),
        (FigureFiles::new(&folder, "chart-px")?, Unit::Pixels),
    ];
    let effort = effort(args);
    let progress = Progress::new("measuring", steps(&effort));
    let sections = measure(&effort, || progress.step())?;
    let elapsed = progress.finish();
    let written = table
        .write(csv::text(&sections).as_bytes())
        .map_err(CommandError::from)
        .and_then(|()| {
            figures.into_iter().try_for_each(|(files, unit)| {
                files.write(&ChartFigure {
                    sections: &sections,
                    unit,
                })
            })
        });
    let mut printer = Printer::new(false);
    let outcome = report(&sections, &mut printer);
    written?;
    message!(
        "measured in {:.0} s, wrote {}",
        elapsed.as_secs_f64(),
        folder.path().display()
    );
    printer.finish()?;
    Ok(outcome)
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
fn report(sections: &[Section], printer: &mut Printer) -> Outcome {
    let Some(far) = sections.first() else {
        return Outcome::Missed;
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
    printer.print(&text);
    if better.is_empty() {
        return Outcome::Done;
    }
    message!("bake: a method beats the default row");
    Outcome::Missed
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
