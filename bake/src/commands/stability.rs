//! `bake stability`: tries every method in every regime.

use super::{CommandError, FigureFiles};
use crate::cli::StabilityArgs;
use lensbake_program::output::OutputFolder;
use lensbake_program::{Outcome, Progress, message};
use lensbake_studies::stability::figure::HeatMap;
use lensbake_studies::stability::{atlas, csv, regimes};

pub fn run(args: &StabilityArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let table = folder.file("atlas.csv")?;
    let at_rest = FigureFiles::new(&folder, "atlas")?;
    let in_motion = FigureFiles::new(&folder, "atlas-motion")?;
    let progress = Progress::new("trying", regimes().len() as u64);
    let atlas = atlas(|| progress.step())?;
    progress.finish();
    table.write(csv::text(&atlas).as_bytes())?;
    for (figure, observers, moves) in [(at_rest, "at rest", false), (in_motion, "in motion", true)]
    {
        let atlas = &atlas.part(moves);
        figure.write(&HeatMap { atlas, observers })?;
    }
    message!(
        "{} methods in {} regimes, wrote {}",
        atlas.columns.len(),
        atlas.lines.len(),
        folder.path().display()
    );
    let failures = atlas.product_failures();
    for (regime, info, verdict) in &failures {
        message!("bake: {}: {}: {verdict}", regime.title(), info.label());
    }
    if failures.is_empty() {
        Ok(Outcome::Done)
    } else {
        Ok(Outcome::Missed)
    }
}
