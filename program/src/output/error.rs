use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a result cannot be written to its path.
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
    /// The folder of the file does not exist.
    #[error("the folder {} does not exist", _0.display())]
    NoFolder(PathBuf),
    /// No file can be created in the folder.
    #[error("no file can be made in the folder {}: {_1}", _0.display())]
    FolderRefuses(PathBuf, io::Error),
    /// The path is a folder.
    #[error("is a folder; name a file")]
    Folder,
    /// The file is read-only.
    #[error("is read-only; make it writable or name another file")]
    ReadOnly,
    /// The path is a block device, such as a disk.
    #[error("is a block device; name a file")]
    BlockDevice,
    /// The output is a stream, and another program must write it to a file.
    #[error("is not a regular file; name one")]
    Stream,
    /// Standard output is a terminal, and the data are not text.
    #[error("standard output is a terminal; redirect it, or name a file")]
    Terminal,
    /// The output is one of the inputs.
    #[error("is also the input {}; name another file", _0.display())]
    AlsoInput(PathBuf),
    /// Two results have the same destination.
    #[error("is named twice, by {} and {}; name two files", _0[0], _0[1])]
    NamedTwice([&'static str; 2]),
    /// The operating system's error.
    #[error("{0}")]
    Io(#[from] io::Error),
}
