//! `bake stability`: where methods fail.

use super::{CommandError, make_directory, write_figure, write_file};
use crate::cli::StabilityArgs;
use bake::stability::figure::HeatMap;
use bake::stability::{atlas, csv, regimes};
use lensbake_report::{Outcome, Progress};

pub fn run(args: &StabilityArgs) -> Result<Outcome, CommandError> {
    make_directory(&args.output)?;
    let progress = Progress::new("trying", regimes().len() as u64);
    let atlas = atlas(|| progress.step())?;
    progress.finish();
    write_file(&args.output.join("atlas.csv"), csv::text(&atlas).as_bytes())?;
    write_figure(&args.output.join("atlas"), &HeatMap { atlas: &atlas })?;
    eprintln!(
        "{} methods in {} regimes, wrote {}",
        atlas.columns.len(),
        atlas.lines.len(),
        args.output.display()
    );
    let failures = atlas.product_failures();
    for (regime, card, verdict) in &failures {
        eprintln!("bake: {}: {}: {verdict}", regime.title(), card.label());
    }
    if failures.is_empty() {
        Ok(Outcome::Done)
    } else {
        Ok(Outcome::Missed)
    }
}
