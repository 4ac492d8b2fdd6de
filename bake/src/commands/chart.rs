//! `bake chart`: speed against accuracy.

use super::{CommandError, FigureFiles};
use crate::cli::ChartArgs;
use lensbake_program::output::OutputFolder;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_studies::figure::front;
use lensbake_studies::method_chart::figure::{ChartFigure, Unit};
use lensbake_studies::method_chart::{
    MeasuredMethod, Section, Workload, csv, measure, rivals, steps,
};

pub fn run(args: &ChartArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let table = folder.file("chart.csv")?;
    let figures = [
        (FigureFiles::new(&folder, "chart-rad")?, Unit::Radians),
        (FigureFiles::new(&folder, "chart-px")?, Unit::Pixels),
    ];
    let workload = workload(args);
    let progress = Progress::new("measuring", steps(&workload));
    let sections = measure(&workload, || progress.step())?;
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

fn workload(args: &ChartArgs) -> Workload {
    if args.quick {
        Workload {
            rays: 500,
            timed_rays: 100,
            rounds: 3,
            batch_us: 50,
            seed: args.seed,
        }
    } else {
        Workload {
            rays: 20_000,
            timed_rays: 1_000,
            rounds: 9,
            batch_us: 1_000,
            seed: args.seed,
        }
    }
}

/// Prints the Pareto front of the methods for the observer at infinity, and the methods that beat the default row;
/// [`Outcome::Missed`] if there are any.
fn report(sections: &[Section], printer: &mut Printer) -> Outcome {
    let Some(far) = sections.first() else {
        return Outcome::Missed;
    };
    let mut text = String::from("      ns   largest error, rad        px   bytes   method\n");
    let point = |entry: &MeasuredMethod| (entry.ns, entry.radians.max);
    let points: Vec<_> = far.entries.iter().map(point).collect();
    for index in front(&points) {
        text += &line(&far.entries[index]);
    }
    text += &format!(
        "noise of this run: {:.1} % of a time\n",
        100.0 * far.noise()
    );
    let better = rivals::better_than_default(far);
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

fn line(entry: &MeasuredMethod) -> String {
    format!(
        "{:8.1}   {:18.2e}  {:8.1e}  {:6}   {}\n",
        entry.ns,
        entry.radians.max,
        entry.pixels.max,
        entry.bytes,
        entry.info.label(),
    )
}
