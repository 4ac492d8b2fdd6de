//! `bake convert`: the same bits in the other container.

use super::CommandError;
use lensbake_report::{Outcome, message};
use lensbake_tables::{ContainerError, container};
use std::path::Path;

pub fn run(from: &Path, to: &Path) -> Result<Outcome, CommandError> {
    let (container, output) = container::output(to)?;
    output.spares(from)?;
    let bytes = container
        .encode(&container::read(from)?)
        .map_err(|problem| ContainerError::new(to, problem))?;
    output.write(&bytes)?;
    message!("wrote {}", output.name());
    Ok(Outcome::Done)
}
