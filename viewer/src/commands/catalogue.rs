//! `viewer catalogue`: the raw Hipparcos file to the compact one.

use super::CommandError;
use crate::cli::CatalogueArgs;
use lensbake_report::{Outcome, message};
use lensbake_tables::output::Output;
use viewer::stars::{self, StarsError};

pub fn run(args: &CatalogueArgs) -> Result<Outcome, CommandError> {
    let output = Output::binary(&args.output)?;
    output.spares(&args.raw)?;
    let raw = stars::read(&args.raw)?;
    let catalogue = stars::read_hipparcos(&raw).map_err(|problem| StarsError {
        path: args.raw.clone(),
        problem,
    })?;
    let bytes = stars::to_bytes(&catalogue);
    output.write(&bytes)?;
    message!(
        "wrote {}: {} stars, {} bytes",
        output.name(),
        catalogue.stars().len(),
        bytes.len()
    );
    Ok(Outcome::Done)
}
