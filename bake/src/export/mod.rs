//! The lookup as a text in another language, and the file of its table: what `bake export` writes.

mod data_file;
mod dialect;
mod header;
mod language;
mod measure;
mod numbers;
mod rewrite;
mod source;
mod text;

pub use data_file::DataFormat;
pub use language::Language;
pub use measure::Errors;
pub use numbers::Precision;

use lensbake_core::Observer;
use lensbake_tables::baking::{Recipe, bake};
use lensbake_tables::lookup::{GpuRow, HorizonSide};
use lensbake_tables::{Rows, Table, TableError};
use numbers::Numbers;
use source::{Place, Shape};
use std::path::PathBuf;
use thiserror::Error;

/// Rows of the atlas above the horizon.
const ATLAS_ROWS: u32 = 128;

/// How a text for all observers looks up the atlas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Mode {
    /// By a row that the caller mixes from the atlas when the radius changes.
    Row,
    /// By one fetch with linear filtering. Simpler and less accurate.
    Simple,
}

impl Mode {
    fn name(self) -> &'static str {
        match self {
            Mode::Row => "row",
            Mode::Simple => "simple",
        }
    }
}

/// What to export.
#[derive(Debug, Clone)]
pub struct Request {
    /// The language.
    pub language: Language,
    /// The one observer that the text is for, at rest or in free fall at a finite radius; `None` for all at rest.
    pub observer: Option<Observer>,
    /// How a text for all observers looks up.
    pub mode: Mode,
    /// Texels of a row.
    pub texels: u32,
    /// Format of the numbers.
    pub precision: Precision,
    /// Name of the function.
    pub function: String,
    /// Path of the table's file as the text names it, and its format.
    pub data: Option<(PathBuf, DataFormat)>,
    /// Whether the file begins with the last row.
    pub flip: bool,
}

/// An exported text, and the bytes of the file beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// The text.
    pub text: String,
    /// The bytes of the table's file.
    pub data: Option<Vec<u8>>,
    /// The error of the numbers.
    pub errors: Errors,
}

/// Why a text cannot be exported.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The language does not have what the mode needs.
    #[error("--to {}: {problem}", language.name())]
    Mode {
        /// The language.
        language: Language,
        /// What is wrong, and what to do.
        problem: &'static str,
    },
    /// A file of this name cannot hold such numbers.
    #[error("{}: the table can be written as {extensions}", path.display())]
    DataFormat {
        /// The path of the file.
        path: PathBuf,
        /// The extensions of the formats that can.
        extensions: String,
    },
    /// An option is for the table's file, and the text holds the table.
    #[error("{option}: a text in {} holds its numbers, and reads no file", language.name())]
    NoDataFile {
        /// The option.
        option: &'static str,
        /// The language.
        language: Language,
    },
    /// A row cannot have this number of texels.
    #[error("--texels: {0}")]
    Texels(TableError),
    /// The table cannot be baked.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The file of the table cannot be encoded.
    #[error("the table cannot be encoded: {0}")]
    Encoding(String),
}

impl Request {
    /// Where the numbers of the text are.
    ///
    /// # Errors
    /// [`ExportError::Mode`] if the language does not have what the mode needs.
    fn place(&self) -> Result<Place, ExportError> {
        let refused = |problem| {
            Err(ExportError::Mode {
                language: self.language,
                problem,
            })
        };
        match (self.observer, self.mode, self.language) {
            (Some(_), ..) => Ok(Place::Array),
            (None, _, Language::Shadertoy) => {
                refused("it has no textures of one's own: add --observer R")
            }
            (None, _, Language::Python) => refused(
                "for all observers there is the package kit/python: install it, or add --observer R",
            ),
            (None, Mode::Simple, Language::C | Language::Osl) => refused(
                "--mode simple needs a filtered texture, which it does not have: take --mode row",
            ),
            (None, Mode::Simple, Language::Three) if self.precision == Precision::Unorm16 => {
                refused("it has no textures of 16-bit integers: take --precision f16 or f32")
            }
            (None, Mode::Simple, _) => Ok(Place::Filtered),
            (None, Mode::Row, Language::Osl) => Ok(Place::Atlas),
            (None, Mode::Row, _) => Ok(Place::Row),
        }
    }

    /// Whether the text reads a file of numbers beside it.
    ///
    /// # Errors
    /// As [`export`].
    pub fn has_data_file(&self) -> Result<bool, ExportError> {
        let reads_file = matches!(self.place()?, Place::Row | Place::Filtered);
        Ok(reads_file && self.language != Language::C)
    }

    /// The command that makes this text again.
    fn command(&self) -> String {
        let mut words = format!("bake export --to {}", self.language.name());
        match self.observer {
            Some(observer) => {
                words += &format!(" --observer {}", observer.radius());
                if !observer.is_at_rest() {
                    words += " --motion fall";
                }
            }
            None => words += &format!(" --mode {}", self.mode.name()),
        }
        words += &format!(
            " --texels {} --precision {}",
            self.texels,
            self.precision.name()
        );
        if self.function != "lensbake" {
            words += &format!(" --function {}", self.function);
        }
        if self.flip {
            words += " --flip";
        }
        words
    }

    /// The table that the numbers come from.
    fn table(&self) -> Result<Table, ExportError> {
        let rows = match self.observer {
            Some(observer) => Rows::One {
                inverse_radius: observer.inverse_radius(),
            },
            None => Rows::Chi { count: ATLAS_ROWS },
        };
        let recipe = Recipe {
            rows,
            texels: self.texels,
            ..Recipe::default()
        };
        bake(&recipe, || ()).map_err(|problem| match problem {
            TableError::Size { .. } => ExportError::Texels(problem),
            other => other.into(),
        })
    }
}

/// Bakes the table that `request` asks for, measures the error of its rounded numbers, and writes the text.
///
/// # Errors
/// [`ExportError`] if the language cannot do what is asked, or a row cannot have that number of texels.
pub fn export(request: &Request) -> Result<Exported, ExportError> {
    let place = request.place()?;
    let table = request.table()?;
    let row = request
        .observer
        .map(|observer| table.row(observer))
        .transpose()?;
    let row = row.map(|row| GpuRow::new(&row));
    let texels = row.as_ref().map_or(table.texels(), |row| &row.texels);
    let numbers = Numbers::new(texels, request.precision);
    let errors = match (request.observer, place) {
        (Some(observer), _) => measure::one_row(observer, &numbers.texels),
        (None, Place::Filtered) => measure::filtered(&table, &numbers),
        (None, _) => measure::rows(&Table::new(table.header().clone(), numbers.texels.clone())?),
    };
    let shape = Shape {
        place,
        texels: row
            .as_ref()
            .map_or(request.texels, |row| row.texels.len() as u32),
        rows: table.header().row_count(),
        edge: row.as_ref().map(|row| row.edge),
        side: row.map_or(HorizonSide::Above, |row| row.side),
    };
    let slopes = place != Place::Filtered;
    let width = request.texels as usize;
    let in_file = match request.flip {
        true => &numbers.last_row_first(width),
        false => &numbers,
    };
    let data = request.data.as_ref();
    let data = data.map(|(_, format)| format.encode(in_file, width, slopes));
    Ok(Exported {
        text: header::header(request, &shape, errors) + &text::text(request, &shape, &numbers),
        data: data.transpose()?,
        errors,
    })
}
