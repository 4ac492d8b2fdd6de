//! `bake convert`: the same bits in the other container.

use super::CommandError;
use lensbake_report::Outcome;
use lensbake_tables::container;
use std::path::Path;

pub fn run(from: &Path, to: &Path) -> Result<Outcome, CommandError> {
    container::check_path(to)?;
    container::write(to, &container::read(from)?)?;
    eprintln!("wrote {}", to.display());
    Ok(Outcome::Done)
}
