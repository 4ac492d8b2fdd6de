//! The commands: arguments in, data to standard output, summaries to standard error.

pub mod bake;
pub mod chart;
pub mod convert;
pub mod diff;
pub mod inspect;
pub mod query;
pub mod stability;

use ::bake::query::QuestionError;
use lensbake_report::PrintError;
use lensbake_report::drawing::{self, DrawError, Figure};
use lensbake_tables::output::{Output, OutputError, OutputFolder};
use lensbake_tables::{ContainerError, Table, TableError, container, default_atlas};
use std::borrow::Cow;
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
        problem: QuestionError,
    },
    /// Standard input.
    #[error("standard input: {0}")]
    Stdin(io::Error),
    /// Standard output.
    #[error(transparent)]
    Print(#[from] PrintError),
    /// A file to write.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A figure.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The thread pool.
    #[error("cannot start the threads asked for with --threads: {0}")]
    Threads(String),
}

/// The table in `file`, or the built-in atlas, with a name to call it by.
fn table_or_atlas(file: Option<&Path>) -> Result<(Cow<'static, Table>, PathBuf), CommandError> {
    Ok(match file {
        Some(path) => (Cow::Owned(container::read(path)?), path.to_owned()),
        None => (Cow::Borrowed(default_atlas()), "the built-in atlas".into()),
    })
}

/// The two files of a figure, checked before the work.
struct FigureFiles {
    svg: Output,
    png: Output,
}

impl FigureFiles {
    /// `name`.svg and `name`.png in `folder`.
    fn new(folder: &OutputFolder, name: &str) -> Result<Self, OutputError> {
        Ok(FigureFiles {
            svg: folder.file(&format!("{name}.svg"))?,
            png: folder.file(&format!("{name}.png"))?,
        })
    }

    /// Draws `figure` to both.
    fn write(&self, figure: &impl Figure) -> Result<(), CommandError> {
        self.svg.write(drawing::svg(figure)?.as_bytes())?;
        Ok(self.png.write(&drawing::png(figure)?)?)
    }
}
