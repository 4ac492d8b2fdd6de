//! The two files a table is kept in. They hold the same bits: either can be made from the other.
//! The layout is written down in `docs/format.md`.

mod binary;
mod openexr;

use crate::error::{ContainerError, Problem};
use crate::header::MAX_TEXELS;
use crate::output::Output;
use crate::{Table, Texel};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Version of both layouts; a file of another is refused.
pub const VERSION: u32 = 1;

/// No table file is larger: the texels as three channels of floats, and room for the header.
const MAX_FILE_BYTES: u64 = MAX_TEXELS * 12 + (1 << 20);

/// One of the two files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Container {
    /// `.lbt`: magic, version, bincode header, little-endian floats, checksum.
    Binary,
    /// `.exr`: OpenEXR, scan lines of RGB float, ZIP; the header as attributes.
    OpenExr,
}

impl Container {
    /// The container that a file's ending asks for.
    ///
    /// # Errors
    /// [`Problem::Ending`] for any other ending than `.lbt` and `.exr`.
    pub fn of(path: &Path) -> Result<Self, ContainerError> {
        let ending = path.extension().and_then(|e| e.to_str());
        match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("lbt") => Ok(Container::Binary),
            Some("exr") => Ok(Container::OpenExr),
            _ => Err(at(path)(Problem::Ending)),
        }
    }

    /// The table as this container's bytes.
    ///
    /// # Errors
    /// [`Problem`] if the encoder refuses, which no valid table makes it do.
    pub fn encode(self, table: &Table) -> Result<Vec<u8>, Problem> {
        match self {
            Container::Binary => binary::encode(table),
            Container::OpenExr => openexr::encode(table),
        }
    }
}

/// Reads a table from a file of either container, told apart by content.
///
/// # Errors
/// [`ContainerError`] names the file and what is wrong with it. Nothing is allocated on the word of
/// a header before the file's own length bears it out.
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

/// Reads a table from the bytes of either container.
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

/// The output at `path` with the container that its ending asks for, checked before any work is done;
/// [`Container::Binary`] for `-`, standard output.
///
/// # Errors
/// [`ContainerError`] if the ending names no container, or as [`Output::binary`].
pub fn output(path: &Path) -> Result<(Container, Output), ContainerError> {
    let output = |container| match Output::binary(path) {
        Ok(output) => Ok((container, output)),
        Err(error) => Err(at(path)(error.problem.into())),
    };
    if path == Path::new("-") {
        return output(Container::Binary);
    }
    output(Container::of(path)?)
}

/// Writes a table to the container that the file's ending asks for, as [`Output::write`] does.
///
/// # Errors
/// [`ContainerError`] names the file and what is wrong.
pub fn write(path: &Path, table: &Table) -> Result<(), ContainerError> {
    let (container, output) = output(path)?;
    container
        .encode(table)
        .and_then(|bytes| output.write(&bytes).map_err(|error| error.problem.into()))
        .map_err(at(path))
}

fn at(path: &Path) -> impl FnOnce(Problem) -> ContainerError {
    move |problem| ContainerError::new(path, problem)
}

/// CRC-32 of the bytes that both containers stand for: the binary header and the texels.
fn checksum(header: &[u8], texels: &[Texel]) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    crc.update(header);
    texels.iter().for_each(|t| {
        crc.update(&t[0].to_le_bytes());
        crc.update(&t[1].to_le_bytes());
    });
    crc.finalize()
}
