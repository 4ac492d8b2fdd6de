#[cfg(feature = "files")]
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a table is invalid or cannot answer a lookup.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TableError {
    /// A size is outside the allowed range.
    #[error("{what} is {found}, but must be from {min} to {max}")]
    Size {
        /// Name of the size.
        what: &'static str,
        /// The value found.
        found: u64,
        /// Smallest value allowed.
        min: u64,
        /// Largest value allowed.
        max: u64,
    },
    /// The number of texels differs from the header's.
    #[error("holds {found} texels where its header says {expected}")]
    TexelCount {
        /// Number of texels according to the header.
        expected: u64,
        /// Number of texels present.
        found: u64,
    },
    /// A texel is NaN or infinite.
    #[error("texel {texel} of row {row} is not a finite number")]
    NotFinite {
        /// Index of the row.
        row: usize,
        /// Index of the texel in the row.
        texel: usize,
    },
    /// A header field has an invalid value.
    #[error("header field '{field}' is {found}: {expected}")]
    Field {
        /// Name of the field.
        field: String,
        /// The value found.
        found: String,
        /// What a valid value is.
        expected: &'static str,
    },
    /// The impact parameter is outside the range of the table's axis.
    #[error(
        "the table holds impact parameters from {b_min} to {b_max} only, not {b}; use a table on the \
         residual axis, or bake one with another --b-min and --b-max"
    )]
    OutsideAxis {
        /// The impact parameter asked for.
        b: f64,
        /// Smallest impact parameter in the table.
        b_min: f64,
        /// Largest impact parameter in the table.
        b_max: f64,
    },
    /// The table holds only the row of another observer.
    #[error(
        "the table holds the row of the observer at r = {holds} only, not at r = {asked}; use the \
         atlas, or bake a row with `bake --observer {asked}`"
    )]
    OtherObserver {
        /// Radius of the observer whose row the table holds.
        holds: f64,
        /// The radius asked for.
        asked: f64,
    },
    /// The table holds no row so far down.
    #[error(
        "the table holds rows down to r = {reach}, not to r = {asked}; the atlas that `bake` writes reaches \
         r = 0.01"
    )]
    NoRowsBelow {
        /// Smallest radius in the table.
        reach: f64,
        /// The radius asked for.
        asked: f64,
    },
}

/// A table file that cannot be read, or a path whose extension is not that of a container.
#[cfg(feature = "files")]
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct ContainerError {
    /// Path of the file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: Problem,
}

#[cfg(feature = "files")]
impl ContainerError {
    /// The error for `problem` in the table file at `path`.
    pub fn new(path: &Path, problem: Problem) -> Self {
        ContainerError {
            path: path.to_owned(),
            problem,
        }
    }
}

/// What is wrong with a table file.
#[cfg(feature = "files")]
#[derive(Debug, Error)]
pub enum Problem {
    /// The operating system reports an error.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The content is that of neither container.
    #[error("not a bending table: neither a lensbake binary file nor an OpenEXR file")]
    NotATable,
    /// The file's extension is neither `.lbt` nor `.exr`.
    #[error("the file's ending must be .lbt (binary) or .exr (OpenEXR)")]
    Ending,
    /// The file is shorter or longer than its header says.
    #[error("is {found} bytes long where its header asks for {expected}: truncated or damaged")]
    Length {
        /// Bytes according to the header.
        expected: u64,
        /// Bytes in the file.
        found: u64,
    },
    /// The file is larger than any table.
    #[error("is longer than {max} bytes; no bending table is larger")]
    TooLarge {
        /// Largest value allowed.
        max: u64,
    },
    /// The file has another version of the format.
    #[error(
        "is of table format version {found}; this program reads versions 1 to {known}: bake it again"
    )]
    Version {
        /// Version of the file.
        found: i64,
        /// Newest version that this program reads.
        known: u32,
    },
    /// The checksum does not match.
    #[error("checksum {found:08x} where {expected:08x} is stored: the file is damaged")]
    Checksum {
        /// As stored in the file.
        expected: u32,
        /// As computed from the content.
        found: u32,
    },
    /// The binary header cannot be decoded.
    #[error("header cannot be decoded: {0}")]
    Header(String),
    /// A header attribute is missing or has the wrong type.
    #[error(
        "has no attribute '{0}' of the kind a bending table has: not written by bake, or damaged"
    )]
    Missing(String),
    /// The OpenEXR layer cannot be decoded.
    #[error("not a readable OpenEXR table: {0}")]
    Exr(String),
    /// The file was decoded, but its content is not a valid table.
    #[error("{0}")]
    Table(#[from] TableError),
}

#[cfg(feature = "files")]
impl Problem {
    /// Whether the file may be something other than a table, such as a picture.
    pub fn is_no_table(&self) -> bool {
        matches!(
            self,
            Problem::Io(_)
                | Problem::NotATable
                | Problem::TooLarge { .. }
                | Problem::Missing(_)
                | Problem::Exr(_)
        )
    }
}
