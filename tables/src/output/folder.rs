//! A folder of results.

use super::resolve::probe;
use super::{Output, OutputError, OutputProblem};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder that a command writes several files to. One that was made for it and is still empty when this
/// value is dropped, since the command failed, is removed.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    is_new: bool,
}

impl OutputFolder {
    /// The folder at `path`, which is made if it is not there.
    ///
    /// # Errors
    /// [`OutputError`] if it can't be made, or takes no file.
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

    /// The output `name` in the folder.
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
            // Fails for a folder with files in it, as it should.
            let _ = fs::remove_dir(&self.path);
        }
    }
}
