//! `bake convert`: writes the same table in the other container, bit for bit.

use super::{CommandError, table_output};
use lensbake_program::{Outcome, message};
use lensbake_tables::{ContainerError, container};
use std::path::Path;

pub fn run(from: &Path, to: &Path) -> Result<Outcome, CommandError> {
    let (container, output) = table_output(to)?;
    output.spares(from)?;
    let bytes = container
        .encode(&container::read(from)?)
        .map_err(|problem| ContainerError::new(to, problem))?;
    output.write(&bytes)?;
    message!("wrote {}", output.name());
    Ok(Outcome::Done)
}
