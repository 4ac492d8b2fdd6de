//! Resolves an output path to its destination.

use super::OutputProblem;
use std::fs::{self, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

/// Longest chain of symbolic links followed; operating systems give up at 40 or fewer.
const MAX_LINKS: usize = 64;

/// The destination of an output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Destination {
    /// Standard output.
    StandardOutput,
    /// A device, a FIFO, or an open descriptor, opened by its own path.
    Stream,
    /// A regular file, existing or not: the target of the last symbolic link.
    File(PathBuf),
}

/// The destination of `path`, checked as far as possible without writing to it.
pub(super) fn resolve(path: &Path) -> Result<Destination, OutputProblem> {
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return new_file(path),
        // A parent of the path is a file.
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
            return Err(OutputProblem::NoFolder(folder_of(path).to_owned()));
        }
        Err(error) => return Err(error.into()),
    };
    if metadata.is_dir() {
        return Err(OutputProblem::Folder);
    }
    if is_block_device(&metadata) {
        return Err(OutputProblem::BlockDevice);
    }
    if !metadata.is_file() || links(path).any(|step| is_descriptor(&step)) {
        return Ok(Destination::Stream);
    }
    // Root could write to the file all the same, but it was made read-only on purpose.
    if metadata.permissions().readonly() {
        return Err(OutputProblem::ReadOnly);
    }
    let target = fs::canonicalize(path)?;
    match OpenOptions::new().write(true).open(&target) {
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => {
            return Err(OutputProblem::ReadOnly);
        }
        opened => opened?,
    };
    probe(folder_of(&target))?;
    Ok(Destination::File(target))
}

/// The file to be created at `path`, or where its chain of symbolic links ends.
fn new_file(path: &Path) -> Result<Destination, OutputProblem> {
    let last = links(path).last().unwrap_or_else(|| path.to_owned());
    if last.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return Err(OutputProblem::NoFolder(last));
    }
    let Some(name) = last.file_name() else {
        return Err(OutputProblem::Folder);
    };
    let folder = folder_of(&last);
    if !folder.is_dir() {
        return Err(OutputProblem::NoFolder(folder.to_owned()));
    }
    let folder = fs::canonicalize(folder)?;
    probe(&folder)?;
    Ok(Destination::File(folder.join(name)))
}

/// The folder that `path` lies in.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Checks that a file can be created in `folder`, by creating a temporary one.
pub(super) fn probe(folder: &Path) -> Result<(), OutputProblem> {
    match tempfile::tempfile_in(folder) {
        Ok(_) => Ok(()),
        Err(error) => Err(OutputProblem::FolderRefuses(folder.to_owned(), error)),
    }
}

/// `path` and the targets of its chain of symbolic links, in order.
fn links(path: &Path) -> impl Iterator<Item = PathBuf> {
    let follow = |link: &PathBuf| {
        let target = fs::read_link(link).ok()?;
        Some(folder_of(link).join(target))
    };
    std::iter::successors(Some(path.to_owned()), follow).take(MAX_LINKS)
}

/// Whether `path` names an open descriptor, whose file must not be replaced.
fn is_descriptor(path: &Path) -> bool {
    path.starts_with("/proc") || path.starts_with("/dev/fd")
}

#[cfg(unix)]
fn is_block_device(metadata: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_block_device()
}

#[cfg(not(unix))]
fn is_block_device(_: &fs::Metadata) -> bool {
    false
}
