//! `viewer catalogue`: the raw Hipparcos file to the compact one.

use super::CommandError;
use crate::cli::CatalogueArgs;
use lensbake_report::Outcome;
use lensbake_tables::container::write_whole;
use viewer::stars::{self, StarsError};

pub fn run(args: &CatalogueArgs) -> Result<Outcome, CommandError> {
    let raw = stars::read(&args.raw)?;
    let catalogue = stars::read_hipparcos(&raw).map_err(|problem| StarsError {
        path: args.raw.clone(),
        problem,
    })?;
    let bytes = stars::to_bytes(&catalogue);
    write_whole(&args.output, &bytes)
        .map_err(|error| CommandError::Folder(args.output.clone(), error))?;
    eprintln!(
        "wrote {}: {} stars, {} bytes",
        args.output.display(),
        catalogue.stars().len(),
        bytes.len()
    );
    Ok(Outcome::Done)
}
