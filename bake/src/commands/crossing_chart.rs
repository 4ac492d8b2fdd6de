//! `bake chart --disc`: speed against accuracy of the methods that find where a ray crosses a disc.

use super::{CommandError, FigureFiles};
use crate::cli::ChartArgs;
use lensbake_program::output::OutputFolder;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_studies::crossing_chart::figure::CrossingFigure;
use lensbake_studies::crossing_chart::{
    CrossingChart, MeasuredCrossing, Workload, csv, measure, steps,
};
use lensbake_studies::figure::front;
use lensbake_studies::timing::Rounds;
use std::time::Duration;

pub fn run(args: &ChartArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let table = folder.file("crossings.csv")?;
    let figure = FigureFiles::new(&folder, "crossings")?;
    let workload = workload(args);
    let progress = Progress::new("measuring", steps(&workload));
    let chart = measure(&workload, || progress.step());
    let elapsed = progress.finish();
    let Some(chart) = chart else {
        return Ok(Outcome::Missed);
    };
    table.write(csv::text(&chart).as_bytes())?;
    figure.write(&CrossingFigure(&chart))?;
    let mut printer = Printer::new(false);
    printer.print(&report(&chart));
    message!(
        "measured in {:.0} s, wrote {}",
        elapsed.as_secs_f64(),
        folder.path().display()
    );
    printer.finish()?;
    Ok(Outcome::Done)
}

fn workload(args: &ChartArgs) -> Workload {
    // Many short timings: on a machine that has other work, most of them are not interrupted.
    let (crossings, timed, count, microseconds) = match args.quick {
        true => (200, 50, 3, 0),
        false => (20_000, 250, 301, 300),
    };
    Workload {
        crossings,
        timed,
        rounds: Rounds {
            count,
            least: Duration::from_micros(microseconds),
        },
        seed: args.seed,
    }
}

/// The Pareto front, and what is used.
fn report(chart: &CrossingChart) -> String {
    let point = |entry: &MeasuredCrossing| (entry.time.ns, entry.errors.pixels.max);
    let points: Vec<_> = chart.entries.iter().map(point).collect();
    let front = front(&points)
        .into_iter()
        .map(|index| &chart.entries[index]);
    let used = chart.entries.iter().filter(|entry| entry.info.used);
    let mut text = String::from("      ns   largest relative error        px   bytes   method\n");
    text.extend(front.map(line));
    text += "used:\n";
    text.extend(used.map(line));
    text += &format!(
        "inputs rounded to f32: {:.1e} of the radius, {:.1e} px\n",
        chart.rounding.relative.max, chart.rounding.pixels.max
    );
    text
}

fn line(entry: &MeasuredCrossing) -> String {
    format!(
        "{:8.1}   {:22.2e}  {:8.1e}  {:6}   {}\n",
        entry.time.ns, entry.errors.relative.max, entry.errors.pixels.max, entry.bytes, entry.label,
    )
}
