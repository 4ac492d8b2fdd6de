//! The two files a table is kept in. They hold the same bits: either can be made from the other.
//! The layout is written down in `docs/format.md`.

mod binary;
mod openexr;

use crate::error::{ContainerError, Problem};
use crate::header::MAX_TEXELS;
use crate::{Table, Texel};
use std::io::Write;
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

fn read_bytes(path: &Path) -> Result<Vec<u8>, Problem> {
    let found = std::fs::metadata(path)?.len();
    if found > MAX_FILE_BYTES {
        return Err(Problem::TooLarge {
            found,
            max: MAX_FILE_BYTES,
        });
    }
    Ok(std::fs::read(path)?)
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

/// Writes a table to the container that the file's ending asks for: to a temporary file beside it,
/// then by renaming, so that nothing half-written is ever there.
///
/// # Errors
/// [`ContainerError`] names the file and what is wrong.
pub fn write(path: &Path, table: &Table) -> Result<(), ContainerError> {
    let container = Container::of(path)?;
    container
        .encode(table)
        .and_then(|bytes| Ok(write_whole(path, &bytes)?))
        .map_err(at(path))
}

/// Checks, before any work is done, that `path` can become a table.
///
/// # Errors
/// [`ContainerError`] if its ending names no container or its folder does not exist.
pub fn check_path(path: &Path) -> Result<(), ContainerError> {
    Container::of(path)?;
    existing_folder(path)
        .map(|_| ())
        .map_err(|e| at(path)(e.into()))
}

/// The folder that `path` lies in.
///
/// # Errors
/// [`std::io::ErrorKind::NotFound`] if it does not exist.
pub fn existing_folder(path: &Path) -> std::io::Result<&Path> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if folder.is_dir() {
        Ok(folder)
    } else {
        let message = format!("the folder {} does not exist", folder.display());
        Err(std::io::Error::new(std::io::ErrorKind::NotFound, message))
    }
}

/// Writes `bytes` to `path` whole or not at all.
///
/// # Errors
/// What the operating system says; the folder must exist.
pub fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let folder = existing_folder(path)?;
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As for any file a program creates: the umask takes its share.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}

fn at(path: &Path) -> impl FnOnce(Problem) -> ContainerError {
    move |problem| ContainerError {
        path: path.to_owned(),
        problem,
    }
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
