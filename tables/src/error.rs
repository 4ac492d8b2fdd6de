use crate::output::OutputProblem;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A table that cannot be, or cannot answer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TableError {
    /// A size outside what a table may have.
    #[error("{what} is {found}, but must be from {min} to {max}")]
    Size {
        /// Which size.
        what: &'static str,
        /// What was found.
        found: u64,
        /// The least allowed.
        min: u64,
        /// The most allowed.
        max: u64,
    },
    /// The number of texels is not what the header says.
    #[error("holds {found} texels where its header says {expected}")]
    TexelCount {
        /// texels × rows by the header.
        expected: u64,
        /// What is there.
        found: u64,
    },
    /// A texel that is NaN or infinite.
    #[error("texel {texel} of row {row} is not a finite number")]
    NotFinite {
        /// Which row.
        row: usize,
        /// Which texel of the row.
        texel: usize,
    },
    /// A header field that makes no sense.
    #[error("header field '{field}' is {found}: {expected}")]
    Field {
        /// Which field.
        field: String,
        /// What was found.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// The table's axis does not reach so far.
    #[error(
        "the table holds impact parameters from {b_min} to {b_max} only, not {b}; use a table on the \
         residual axis, or bake one with another --b-min and --b-max"
    )]
    OutsideAxis {
        /// What was asked for.
        b: f64,
        /// The least that the table holds.
        b_min: f64,
        /// The greatest.
        b_max: f64,
    },
    /// The table holds one observer only, and it is another.
    #[error(
        "the table holds the row of the observer at r = {holds} only, not at r = {asked}; use the \
         atlas, or bake a row with `bake --observer {asked}`"
    )]
    OtherObserver {
        /// The observer's radius the table holds.
        holds: f64,
        /// The radius asked for.
        asked: f64,
    },
}

/// A table file that cannot be read or written.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct ContainerError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: Problem,
}

impl ContainerError {
    /// What is wrong with the table file at `path`.
    pub fn new(path: &Path, problem: Problem) -> Self {
        ContainerError {
            path: path.to_owned(),
            problem,
        }
    }
}

/// What is wrong with a table file.
#[derive(Debug, Error)]
pub enum Problem {
    /// The operating system says no.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// Neither container.
    #[error("not a bending table: neither a lensbake binary file nor an OpenEXR file")]
    NotATable,
    /// The file's ending names no container.
    #[error("the file's ending must be .lbt (binary) or .exr (OpenEXR)")]
    Ending,
    /// Too short, or too long.
    #[error("is {found} bytes long where its header asks for {expected}: truncated or damaged")]
    Length {
        /// By the header.
        expected: u64,
        /// By the file system.
        found: u64,
    },
    /// It cannot be written.
    #[error(transparent)]
    Output(#[from] OutputProblem),
    /// Larger than any table.
    #[error("is longer than {max} bytes; no bending table is larger")]
    TooLarge {
        /// The most allowed.
        max: u64,
    },
    /// Another version of the format.
    #[error(
        "is of table format version {found}; this program reads version {known}: bake it again"
    )]
    Version {
        /// In the file.
        found: i64,
        /// Read by this program.
        known: u32,
    },
    /// The checksum does not fit.
    #[error("checksum {found:08x} where {expected:08x} is stored: the file is damaged")]
    Checksum {
        /// As stored.
        expected: u32,
        /// As computed.
        found: u32,
    },
    /// The binary header cannot be decoded.
    #[error("header cannot be decoded: {0}")]
    Header(String),
    /// A header attribute is missing.
    #[error(
        "has no attribute '{0}' of the kind a bending table has: not written by bake, or damaged"
    )]
    Missing(String),
    /// The EXR layer cannot be decoded.
    #[error("not a readable OpenEXR table: {0}")]
    Exr(String),
    /// Decoded, but no table.
    #[error("{0}")]
    Table(#[from] TableError),
}
