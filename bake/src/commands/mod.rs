//! The commands: arguments in, data to standard output, summaries to standard error.

pub mod bake;
pub mod chart;
pub mod convert;
pub mod diff;
pub mod inspect;
pub mod query;
pub mod stability;

use lensbake_report::drawing::{self, Figure};
use lensbake_tables::{ContainerError, Table, TableError, container, default_atlas};
use std::borrow::Cow;
use std::error::Error;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a command could not do its work.
#[derive(Debug, Error)]
pub enum CommandError {
    /// A table file.
    #[error(transparent)]
    Container(#[from] ContainerError),
    /// A recipe that makes no table.
    #[error("{0}")]
    Table(#[from] TableError),
    /// A table that does not answer what was asked.
    #[error("{}: {problem}", path.display())]
    InTable {
        /// The file, or what stands for it.
        path: PathBuf,
        /// What is wrong.
        problem: TableError,
    },
    /// A line of input.
    #[error("standard input, line {line}: {problem}")]
    Line {
        /// Which line, from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// Standard input.
    #[error("standard input: {0}")]
    Stdin(io::Error),
    /// Standard output.
    #[error("standard output: {0}")]
    Stdout(io::Error),
    /// Another file that was to be written.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// The thread pool.
    #[error("cannot start the threads asked for with --threads: {0}")]
    Threads(String),
}

impl CommandError {
    /// Whether the reader of standard output has gone.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, CommandError::Stdout(e) if e.kind() == io::ErrorKind::BrokenPipe)
    }
}

/// The table in `file`, or the built-in atlas, with a name to call it by.
fn table_or_atlas(file: Option<&Path>) -> Result<(Cow<'static, Table>, PathBuf), CommandError> {
    Ok(match file {
        Some(path) => (Cow::Owned(container::read(path)?), path.to_owned()),
        None => (Cow::Borrowed(default_atlas()), "the built-in atlas".into()),
    })
}

/// Writes `bytes` to `path` whole or not at all.
fn write_file(path: &Path, bytes: &[u8]) -> Result<(), CommandError> {
    container::write_whole(path, bytes).map_err(|e| CommandError::File {
        path: path.to_owned(),
        problem: e.to_string(),
    })
}

/// Makes sure that there is a directory at `path`.
fn make_directory(path: &Path) -> Result<(), CommandError> {
    fs::create_dir_all(path).map_err(|e| CommandError::File {
        path: path.to_owned(),
        problem: e.to_string(),
    })
}

/// Draws `figure` to `stem`.svg and `stem`.png.
fn write_figure(stem: &Path, figure: &impl Figure) -> Result<(), CommandError> {
    let undrawn = |path: &Path, e: Box<dyn Error>| CommandError::File {
        path: path.to_owned(),
        problem: e.to_string(),
    };
    let path = stem.with_extension("svg");
    let svg = drawing::svg(figure).map_err(|e| undrawn(&path, e))?;
    write_file(&path, svg.as_bytes())?;
    let path = stem.with_extension("png");
    let png = drawing::png(figure).map_err(|e| undrawn(&path, e))?;
    write_file(&path, &png)
}
