//! The two file formats of a table, called containers. They hold the same bits: either can be made from the other.
//! `docs/format.md` documents their layout.

mod binary;
mod openexr;

use crate::error::{ContainerError, Problem};
use crate::header::MAX_TEXELS;
use crate::{Table, Texel};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Version of both layouts that is written. Files of all versions up to this one are read.
pub const VERSION: u32 = Version::NEWEST.number();

/// The versions of the layouts. Version 2 added rows below the horizon and their error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Version {
    One,
    Two,
}

impl Version {
    const NEWEST: Version = Version::Two;

    const fn number(self) -> u32 {
        match self {
            Version::One => 1,
            Version::Two => 2,
        }
    }

    /// The version with this number.
    fn new(number: i64) -> Result<Self, Problem> {
        match number {
            1 => Ok(Version::One),
            2 => Ok(Version::Two),
            _ => Err(Problem::Version {
                found: number,
                known: VERSION,
            }),
        }
    }
}

/// Most bytes of a table file: the texels as three channels of floats, and an allowance for the header.
const MAX_FILE_BYTES: u64 = MAX_TEXELS * 12 + (1 << 20);

/// One of the two file formats of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Container {
    /// `.lbt`: magic, version, bincode header, little-endian floats, checksum.
    Binary,
    /// `.exr`: OpenEXR with scan lines of RGB float, compressed by ZIP; the header as attributes.
    OpenExr,
}

impl Container {
    /// The container for the extension of `path`.
    ///
    /// # Errors
    /// [`Problem::Ending`] for any extension other than `.lbt` and `.exr`.
    pub fn of(path: &Path) -> Result<Self, ContainerError> {
        let ending = path.extension().and_then(|e| e.to_str());
        match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("lbt") => Ok(Container::Binary),
            Some("exr") => Ok(Container::OpenExr),
            _ => Err(at(path)(Problem::Ending)),
        }
    }

    /// The bytes of `table` in this container.
    ///
    /// # Errors
    /// [`Problem`] if the encoder fails, which does not happen with a valid table.
    pub fn encode(self, table: &Table) -> Result<Vec<u8>, Problem> {
        match self {
            Container::Binary => binary::encode(table),
            Container::OpenExr => openexr::encode(table),
        }
    }
}

/// Reads a table from a file in either container, which is recognised by its content.
///
/// # Errors
/// [`ContainerError`] names the file and what is wrong with it. No memory is allocated for a size stated in the
/// header until the length of the file confirms it.
pub fn read(path: &Path) -> Result<Table, ContainerError> {
    read_bytes(path)
        .and_then(|bytes| from_bytes(&bytes))
        .map_err(at(path))
}

/// The bytes of a file, a device or a FIFO, up to the size of the largest table.
fn read_bytes(path: &Path) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(Problem::TooLarge {
            max: MAX_FILE_BYTES,
        });
    }
    Ok(bytes)
}

/// Reads a table from bytes in either container.
///
/// # Errors
/// [`Problem`] says what is wrong.
pub fn from_bytes(bytes: &[u8]) -> Result<Table, Problem> {
    if bytes.starts_with(&binary::MAGIC) {
        binary::decode(bytes)
    } else if bytes.starts_with(&openexr::MAGIC) {
        openexr::decode(bytes)
    } else {
        Err(Problem::NotATable)
    }
}

fn at(path: &Path) -> impl FnOnce(Problem) -> ContainerError {
    move |problem| ContainerError::new(path, problem)
}

/// CRC-32 of the content that both containers have in common: the binary header and the texels.
fn checksum(header: &[u8], texels: &[Texel]) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    crc.update(header);
    texels.iter().for_each(|t| {
        crc.update(&t[0].to_le_bytes());
        crc.update(&t[1].to_le_bytes());
    });
    crc.finalize()
}
