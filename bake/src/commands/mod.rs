//! The commands. Data goes to standard output, summaries to standard error.

pub mod bake;
pub mod chart;
pub mod convert;
pub mod crossing_chart;
pub mod diff;
pub mod export;
pub mod inspect;
pub mod luminet;
pub mod query;
pub mod stability;

use ::bake::export::ExportError;
use ::bake::query::QuestionError;
use lensbake_core::thin_disc::ThinDiscError;
use lensbake_core::{CoreError, Motion};
use lensbake_program::PrintError;
use lensbake_program::output::{Output, OutputError, OutputFolder};
use lensbake_studies::figure::drawing::{self, DrawError, Figure};
use lensbake_tables::container::{self, Container};
use lensbake_tables::{ContainerError, Table, TableError, default_atlas};
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a command failed.
#[derive(Debug, Error)]
pub enum CommandError {
    /// A table file cannot be read or written.
    #[error(transparent)]
    Container(#[from] ContainerError),
    /// The recipe does not make a table.
    #[error("{0}")]
    Table(#[from] TableError),
    /// The table cannot answer what was asked.
    #[error("{}: {problem}", path.display())]
    InTable {
        /// The file, or the name of the built-in atlas.
        path: PathBuf,
        /// What is wrong.
        problem: TableError,
    },
    /// Nobody can move as `--motion` says at the radius of the table's row.
    #[error("--motion {motion}: {problem}")]
    Motion {
        /// The motion.
        motion: Motion,
        /// What is wrong.
        problem: CoreError,
    },
    /// The disc of a query is none.
    #[error("--disc: {0}")]
    Disc(ThinDiscError),
    /// A line of standard input is not a question.
    #[error("standard input, line {line}: {problem}")]
    Line {
        /// Line number, from 1.
        line: usize,
        /// What is wrong.
        problem: QuestionError,
    },
    /// Standard input cannot be read.
    #[error("standard input: {0}")]
    Stdin(io::Error),
    /// Standard output cannot be written.
    #[error(transparent)]
    Print(#[from] PrintError),
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The observer of a text cannot be at this radius.
    #[error("--observer {radius}: the radius, in units of the Schwarzschild radius, {wanted}")]
    ExportRadius {
        /// The radius.
        radius: f64,
        /// What it must be.
        wanted: &'static str,
    },
    /// A text cannot be exported.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A figure cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The thread pool cannot be started.
    #[error("cannot start the threads asked for with --threads: {0}")]
    Threads(String),
}

/// The table in `file`, or the built-in atlas, with its name for messages.
fn table_or_atlas(file: Option<&Path>) -> Result<(Cow<'static, Table>, PathBuf), CommandError> {
    Ok(match file {
        Some(path) => (Cow::Owned(container::read(path)?), path.to_owned()),
        None => (Cow::Borrowed(default_atlas()), "the built-in atlas".into()),
    })
}

/// The output at `path`, checked before the work, and its container: that of the path's extension, or `.lbt` for
/// `-`, standard output.
fn table_output(path: &Path) -> Result<(Container, Output), CommandError> {
    let container = match path == Path::new("-") {
        true => Container::Binary,
        false => Container::of(path)?,
    };
    Ok((container, Output::binary(path)?))
}

/// The SVG and the PNG file of a figure, checked before the work.
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

    /// Draws `figure` to both files.
    fn write(&self, figure: &impl Figure) -> Result<(), CommandError> {
        self.svg.write(drawing::svg(figure)?.as_bytes())?;
        Ok(self.png.write(&drawing::png(figure)?)?)
    }
}
