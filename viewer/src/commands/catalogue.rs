//! `viewer catalogue`: converts the raw Hipparcos file to the compact catalogue.

use super::CommandError;
use crate::cli::CatalogueArgs;
use lensbake_program::output::Output;
use lensbake_program::{Outcome, message};
use lensbake_render::stars::{self, StarsError};

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
