use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A result that cannot be written where it should go.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct OutputError {
    /// The path as it was given.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: OutputProblem,
}

impl OutputError {
    pub(super) fn new(path: &Path, problem: OutputProblem) -> Self {
        OutputError {
            path: path.to_owned(),
            problem,
        }
    }
}

/// Why nothing can be written to a path.
#[derive(Debug, Error)]
pub enum OutputProblem {
    /// The folder that the file should be in is not there.
    #[error("the folder {} does not exist", _0.display())]
    NoFolder(PathBuf),
    /// No file can be made in the folder.
    #[error("no file can be made in the folder {}: {_1}", _0.display())]
    FolderRefuses(PathBuf, io::Error),
    /// The path is a folder.
    #[error("is a folder; name a file")]
    Folder,
    /// The file has no permission to be written.
    #[error("is read-only; make it writable or name another file")]
    ReadOnly,
    /// A disk.
    #[error("is a block device; name a file")]
    BlockDevice,
    /// Standard output is a terminal, and the data are not text.
    #[error("standard output is a terminal; redirect it, or name a file")]
    Terminal,
    /// The output is one of the inputs.
    #[error("is also the input {}; name another file", _0.display())]
    AlsoInput(PathBuf),
    /// Two results would go to the same place.
    #[error("is named twice, by {} and {}; name two files", _0[0], _0[1])]
    NamedTwice([&'static str; 2]),
    /// The operating system says no.
    #[error("{0}")]
    Io(#[from] io::Error),
}
