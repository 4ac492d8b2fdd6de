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
    /// The file cannot be read.
    #[error("cannot be read ({0}); check the path and its permissions")]
    Io(#[from] io::Error),
    /// The file is larger than any catalogue needs to be.
    #[error("is larger than {} MiB; no catalogue needs more", max >> 20)]
    TooLarge {
        /// Largest file that is read, bytes.
        max: u64,
    },
    /// There is no star.
    #[error("holds no star")]
    Empty,
    /// There are too many stars.
    #[error("holds more than {max} stars; leave out the faintest")]
    TooMany {
        /// Largest number allowed.
        max: usize,
    },
    /// A column is missing in a CSV file.
    #[error(
        "has no column '{0}'; its first line must name the columns ra and dec (degrees), mag and, if \
         known, bv, separated by commas"
    )]
    Column(&'static str),
    /// A CSV line cannot be parsed.
    #[error("line {line} is not CSV text ({reason})")]
    Line {
        /// Line number, from 1.
        line: u64,
        /// Why it cannot be parsed.
        reason: &'static str,
    },
    /// A value in a CSV file is not a number or out of range.
    #[error("line {line}: {column} is '{found}'; it must be {expected}")]
    Value {
        /// Line number, from 1.
        line: u64,
        /// Name of the column.
        column: &'static str,
        /// The text found, shortened.
        found: String,
        /// What is expected.
        expected: &'static str,
    },
    /// A compact catalogue is of an unknown version.
    #[error("is of catalogue format version {found}; this program reads version 1")]
    Version {
        /// Version of the file.
        found: u32,
    },
    /// A compact catalogue is truncated, or something follows its end.
    #[error("is {found} bytes long where its header asks for {expected}: truncated or damaged")]
    Length {
        /// Length according to the header, bytes.
        expected: u64,
        /// Length of the file, bytes.
        found: u64,
    },
    /// A compact catalogue is damaged.
    #[error("checksum {found:08x} where {expected:08x} is stored: the file is damaged")]
    Checksum {
        /// Checksum stored in the file.
        expected: u32,
        /// Checksum computed from the file.
        found: u32,
    },
    /// The angular radius of the stars (rad) is out of range.
    #[error("its stars have an angular radius of {0} rad; it must be above 0 and at most 0.001")]
    DiscRadius(f64),
    /// A line is not a record of the raw Hipparcos file.
    #[error("line {line} is no record of hip2.dat (CDS catalogue I/311): {what}")]
    NotHipparcos {
        /// Line number, from 1.
        line: usize,
        /// Why it is not a record.
        what: &'static str,
    },
}
