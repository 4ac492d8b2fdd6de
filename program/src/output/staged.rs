//! A file that another program writes.

use super::resolve::{Destination, folder_of};
use super::{Output, OutputError, OutputProblem, put_in_place, temporary_file};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A temporary file beside the file of an output, for another program to write. It takes the output's place when
/// [`Staged::commit`] is called; otherwise it is removed when this value is dropped.
#[derive(Debug)]
pub struct Staged {
    file: NamedTempFile,
    target: PathBuf,
    /// The path of the output as it was given.
    path: PathBuf,
}

impl Output {
    /// A temporary file beside this output, with the same file extension.
    ///
    /// # Errors
    /// [`OutputError`] if it can't be created, or the output is a stream.
    pub fn stage(&self) -> Result<Staged, OutputError> {
        let Destination::File(target) = &self.destination else {
            return Err(OutputError::new(&self.path, OutputProblem::Stream));
        };
        let extension = target.extension().unwrap_or_default().to_string_lossy();
        let file = temporary_file(folder_of(target), &format!(".{extension}"));
        Ok(Staged {
            file: file.map_err(|error| OutputError::new(&self.path, error.into()))?,
            target: target.clone(),
            path: self.path.clone(),
        })
    }
}

impl Staged {
    /// The temporary file.
    pub fn path(&self) -> &Path {
        self.file.path()
    }

    /// Lets the temporary file take the output's place.
    ///
    /// # Errors
    /// [`OutputError`] with the operating system's error.
    pub fn commit(self) -> Result<(), OutputError> {
        let placed = put_in_place(self.file, &self.target);
        placed.map_err(|error| OutputError::new(&self.path, error.into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn it_takes_the_place_of_the_output_or_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.mp4");
        fs::write(&target, "old").unwrap();
        let output = Output::new(&target).unwrap();
        let staged = output.stage().unwrap();
        assert_eq!(staged.path().extension(), target.extension());
        fs::write(staged.path(), "new").unwrap();
        assert_eq!(fs::read(&target).unwrap(), b"old");
        staged.commit().unwrap();
        assert_eq!(fs::read(&target).unwrap(), b"new");
        drop(output.stage().unwrap());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        let stream = Output::new(Path::new("-")).unwrap().stage();
        assert!(stream.unwrap_err().to_string().contains("regular file"));
    }
}
