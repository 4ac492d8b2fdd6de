//! A folder for several output files.

use super::resolve::probe;
use super::{Output, OutputError, OutputProblem};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder that a command writes several files to. If it was created for the command and is still empty when this
/// value is dropped, because the command failed, it is removed.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    is_new: bool,
}

impl OutputFolder {
    /// The folder at `path`, created if it does not exist.
    ///
    /// # Errors
    /// [`OutputError`] if it can't be created, or no file can be created in it.
    pub fn new(path: &Path) -> Result<Self, OutputError> {
        let is_new = !path.exists();
        fs::create_dir_all(path)
            .map_err(OutputProblem::Io)
            .and_then(|()| probe(path))
            .map_err(|problem| OutputError::new(path, problem))?;
        Ok(OutputFolder {
            path: path.to_owned(),
            is_new,
        })
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The output file `name` in the folder.
    ///
    /// # Errors
    /// As [`Output::new`].
    pub fn file(&self, name: &str) -> Result<Output, OutputError> {
        Output::new(&self.path.join(name))
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        if self.is_new {
            // Fails for a folder that is not empty, as intended.
            let _ = fs::remove_dir(&self.path);
        }
    }
}
