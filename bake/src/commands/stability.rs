//! `bake stability`: where methods fail.

use super::{CommandError, FigureFiles};
use crate::cli::StabilityArgs;
use bake::stability::figure::HeatMap;
use bake::stability::{atlas, csv, regimes};
use lensbake_report::{Outcome, Progress, message};
use lensbake_tables::output::OutputFolder;

pub fn run(args: &StabilityArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let table = folder.file("atlas.csv")?;
    let figure = FigureFiles::new(&folder, "atlas")?;
    let progress = Progress::new("trying", regimes().len() as u64);
    let atlas = atlas(|| progress.step())?;
    progress.finish();
    table.write(csv::text(&atlas).as_bytes())?;
    figure.write(&HeatMap { atlas: &atlas })?;
    message!(
        "{} methods in {} regimes, wrote {}",
        atlas.columns.len(),
        atlas.lines.len(),
        folder.path().display()
    );
    let failures = atlas.product_failures();
    for (regime, card, verdict) in &failures {
        message!("bake: {}: {}: {verdict}", regime.title(), card.label());
    }
    if failures.is_empty() {
        Ok(Outcome::Done)
    } else {
        Ok(Outcome::Missed)
    }
}
