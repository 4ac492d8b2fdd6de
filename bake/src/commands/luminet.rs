//! `bake luminet`: a thin disc as an observer far away sees it.

use super::{CommandError, FigureFiles};
use crate::cli::LuminetArgs;
use lensbake_program::output::OutputFolder;
use lensbake_program::{Outcome, Printer, message};
use lensbake_studies::luminet::figure::LuminetFigure;
use lensbake_studies::luminet::{Brightest, Comparison, comparisons, csv, curves};

pub fn run(args: &LuminetArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let table = folder.file("luminet.csv")?;
    let figure = FigureFiles::new(&folder, "luminet")?;
    let found = curves(args.inclination.to_radians());
    table.write(csv::text(&found).as_bytes())?;
    figure.write(&LuminetFigure {
        curves: &found,
        inclination_deg: args.inclination,
    })?;
    let mut printer = Printer::new(false);
    printer.print(&brightest(&found.brightest));
    for comparison in comparisons() {
        printer.print(&line(&comparison));
    }
    printer.finish()?;
    message!("wrote {}", folder.path().display());
    Ok(Outcome::Done)
}

fn brightest(point: &Brightest) -> String {
    let Brightest {
        radius,
        place: [x, y],
        redshift,
        flux,
    } = point;
    format!(
        "brightest point: flux {flux:.4}, r = {radius:.3} M, z = {redshift:.4}, at x = {x:.3} M, y = {y:.3} M\n"
    )
}

fn line(comparison: &Comparison) -> String {
    let Comparison {
        what,
        published,
        computed,
        quoted_by,
    } = comparison;
    format!("{what}: published {published} ({quoted_by}), here {computed:.5}\n")
}
