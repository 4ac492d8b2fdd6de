//! A folder of results.

use super::resolve::probe;
use super::{Output, OutputError, OutputProblem};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder that a command writes several files to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// The folder at `path`, which is made if it is not there.
    ///
    /// # Errors
    /// [`OutputError`] if it can't be made, or takes no file.
    pub fn new(path: &Path) -> Result<Self, OutputError> {
        fs::create_dir_all(path)
            .map_err(OutputProblem::Io)
            .and_then(|()| probe(path))
            .map_err(|problem| OutputError::new(path, problem))?;
        Ok(OutputFolder {
            path: path.to_owned(),
        })
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The output `name` in the folder.
    ///
    /// # Errors
    /// As [`Output::new`].
    pub fn file(&self, name: &str) -> Result<Output, OutputError> {
        Output::new(&self.path.join(name))
    }
}
