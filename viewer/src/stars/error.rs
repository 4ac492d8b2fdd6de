use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A star catalogue that cannot be used.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct StarsError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: StarsProblem,
}

impl StarsError {
    pub(super) fn new(path: &Path, problem: StarsProblem) -> Self {
        StarsError {
            path: path.to_owned(),
            problem,
        }
    }
}

/// What is wrong with a catalogue. Each message is one line.
#[derive(Debug, Error)]
pub enum StarsProblem {
    /// The operating system says no.
    #[error("cannot be read ({0}); check the path and its permissions")]
    Io(#[from] io::Error),
    /// More bytes than any catalogue.
    #[error("is larger than {} MiB; no catalogue needs more", max >> 20)]
    TooLarge {
        /// The most that is read, bytes.
        max: u64,
    },
    /// Nothing in it.
    #[error("holds no star")]
    Empty,
    /// More stars than are drawn.
    #[error("holds more than {max} stars; leave out the faintest")]
    TooMany {
        /// The most allowed.
        max: usize,
    },
    /// A CSV file without a column.
    #[error(
        "has no column '{0}'; its first line must name the columns ra and dec (degrees), mag and, if \
         known, bv, separated by commas"
    )]
    Column(&'static str),
    /// A CSV line that cannot be taken apart.
    #[error("line {line} is not CSV text ({reason})")]
    Line {
        /// Which line, from 1.
        line: u64,
        /// What the reader says.
        reason: &'static str,
    },
    /// A value that is none.
    #[error("line {line}: {column} is '{found}'; it must be {expected}")]
    Value {
        /// Which line, from 1.
        line: u64,
        /// Which column.
        column: &'static str,
        /// What was found, shortened.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// The compact format in another version.
    #[error("is of catalogue format version {found}; this program reads version 1")]
    Version {
        /// In the file.
        found: u32,
    },
    /// The compact format, truncated or with something after its end.
    #[error("is {found} bytes long where its header asks for {expected}: truncated or damaged")]
    Length {
        /// By the header.
        expected: u64,
        /// As it is.
        found: u64,
    },
    /// The compact format, damaged.
    #[error("checksum {found:08x} where {expected:08x} is stored: the file is damaged")]
    Checksum {
        /// As stored.
        expected: u32,
        /// As computed.
        found: u32,
    },
    /// An angular radius of the stars that makes no sense.
    #[error("its stars have an angular radius of {0} rad; it must be above 0 and at most 0.001")]
    DiscRadius(f64),
    /// Not the raw Hipparcos file.
    #[error("line {line} is no record of hip2.dat (CDS catalogue I/311): {what}")]
    NotHipparcos {
        /// Which line, from 1.
        line: usize,
        /// What is wrong.
        what: &'static str,
    },
}
