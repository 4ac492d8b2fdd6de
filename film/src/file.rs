//! Reads a path from a file.

use crate::{Flight, FlightPath, PathError};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest file that is read, bytes.
const MAX_BYTES: u64 = 1 << 24;

/// Why a file cannot be read as the path of a flight.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct PathFileError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: PathFileProblem,
}

/// What is wrong with the file of a path.
#[derive(Debug, Error)]
pub enum PathFileProblem {
    /// The operating system's error.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// The file is too large.
    #[error("is larger than 16 MiB, the most that a path may have")]
    TooLarge,
    /// The text is not a path, or the path cannot be flown.
    #[error(transparent)]
    Path(#[from] PathError),
}

/// Reads the path in the file `path`, and checks it.
///
/// # Errors
/// [`PathFileError`] names the file, and the field if one is wrong.
pub fn read(path: &Path) -> Result<(FlightPath, Flight), PathFileError> {
    checked(path).map_err(|problem| PathFileError {
        path: path.to_owned(),
        problem,
    })
}

fn checked(path: &Path) -> Result<(FlightPath, Flight), PathFileProblem> {
    let mut text = String::new();
    let file = File::open(path)?;
    file.take(MAX_BYTES + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MAX_BYTES {
        return Err(PathFileProblem::TooLarge);
    }
    let path: FlightPath = text.parse()?;
    let flight = Flight::new(&path)?;
    Ok((path, flight))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.json");
        let said = |text: Option<&[u8]>| {
            if let Some(text) = text {
                std::fs::write(&file, text).unwrap();
            }
            let said = read(&file).unwrap_err().to_string();
            assert!(said.contains("a.json: "), "{said}");
            said
        };
        assert!(said(None).contains("No such file") || cfg!(not(unix)));
        assert!(said(Some(b"{\"keyframes\": []}")).contains("keyframes: the path has none"));
        assert!(said(Some(b"\xff\xfe")).contains("UTF-8"));
        let long = vec![b' '; MAX_BYTES as usize + 1];
        assert!(said(Some(&long)).contains("16 MiB"));
    }
}
