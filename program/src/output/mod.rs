//! Where a program writes its results: to a file, whole or not at all, or to a stream.
//!
//! An [`Output`] is created, and so checked, before the work begins, and written after it:
//!
//! - A regular file is written to a temporary file beside it, which then takes its place: an interruption
//!   leaves the old file or the new one. The mode and the owner of a file that exists are kept, a symbolic
//!   link is followed, and a read-only file is refused.
//! - A device, a FIFO or an open descriptor such as `/dev/stdout` is written to as it is.
//! - `-` is standard output.

mod error;
mod folder;
mod resolve;
mod staged;

pub use error::{OutputError, OutputProblem};
pub use folder::OutputFolder;
pub use staged::Staged;

use resolve::{Destination, resolve};
use std::borrow::Cow;
use std::fs::{self, File, OpenOptions};
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The path for standard output.
const STANDARD_OUTPUT: &str = "-";

/// The destination of one result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    path: PathBuf,
    destination: Destination,
}

impl Output {
    /// The output at `path`, `-` for standard output. Creates no file that stays.
    ///
    /// # Errors
    /// [`OutputError`] if nothing can be written there: the folder does not exist or no file can be created in it,
    /// or the path is a folder, a block device or a read-only file.
    pub fn new(path: &Path) -> Result<Self, OutputError> {
        let destination = if path == Path::new(STANDARD_OUTPUT) {
            Ok(Destination::StandardOutput)
        } else {
            resolve(path)
        };
        match destination {
            Ok(destination) => Ok(Output {
                path: path.to_owned(),
                destination,
            }),
            Err(problem) => Err(OutputError::new(path, problem)),
        }
    }

    /// As [`Output::new`], for binary data, which is not written to a terminal.
    ///
    /// # Errors
    /// As [`Output::new`], and [`OutputProblem::Terminal`].
    pub fn binary(path: &Path) -> Result<Self, OutputError> {
        let output = Output::new(path)?;
        if output.is_standard_output() && io::stdout().is_terminal() {
            return Err(OutputError::new(path, OutputProblem::Terminal));
        }
        Ok(output)
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its name in messages: the path, or "standard output".
    pub fn name(&self) -> Cow<'_, str> {
        match self.destination {
            Destination::StandardOutput => "standard output".into(),
            Destination::Stream | Destination::File(_) => self.path.to_string_lossy(),
        }
    }

    /// Whether it is standard output.
    pub fn is_standard_output(&self) -> bool {
        self.destination == Destination::StandardOutput
    }

    /// Writes `bytes`: a file whole or not at all. If the reader of standard output has closed the pipe, that is
    /// no error.
    ///
    /// # Errors
    /// [`OutputError`] with the operating system's error.
    pub fn write(&self, bytes: &[u8]) -> Result<(), OutputError> {
        let written = match &self.destination {
            Destination::StandardOutput => write_to_standard_output(bytes),
            // A descriptor may lead to a regular file, whose content must stay: append.
            Destination::Stream => OpenOptions::new()
                .append(true)
                .open(&self.path)
                .and_then(|mut stream| stream.write_all(bytes)),
            Destination::File(target) => replace(target, bytes),
        };
        written.map_err(|error| OutputError::new(&self.path, OutputProblem::Io(error)))
    }

    /// Checks that this output would not be written over the file `input`.
    ///
    /// # Errors
    /// [`OutputProblem::AlsoInput`] if it would: by this name, a link, or another name of the same file.
    pub fn spares(&self, input: &Path) -> Result<(), OutputError> {
        let same = match &self.destination {
            // To compare the files opens them, and whoever writes to a FIFO would take that for its reader.
            Destination::File(target) if input.is_file() => {
                same_file::is_same_file(target, input).unwrap_or(false)
            }
            Destination::File(_) | Destination::StandardOutput | Destination::Stream => false,
        };
        if same {
            let problem = OutputProblem::AlsoInput(input.to_owned());
            return Err(OutputError::new(&self.path, problem));
        }
        Ok(())
    }

    /// Checks that this output and `other` have different destinations; `names` are the flags that set them.
    ///
    /// # Errors
    /// [`OutputProblem::NamedTwice`] if both would be written to one file or to standard output.
    pub fn is_apart(&self, other: &Output, names: [&'static str; 2]) -> Result<(), OutputError> {
        if self.destination == other.destination && self.destination != Destination::Stream {
            let problem = OutputProblem::NamedTwice(names);
            return Err(OutputError::new(&self.path, problem));
        }
        Ok(())
    }
}

/// Creates the output at `path` and writes `bytes` to it.
///
/// # Errors
/// As for [`Output::new`] and [`Output::write`].
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    Output::new(path)?.write(bytes)
}

fn write_to_standard_output(bytes: &[u8]) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// Creates `target` with these bytes, or replaces it atomically.
fn replace(target: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = temporary_file(resolve::folder_of(target), "")?;
    file.write_all(bytes)?;
    put_in_place(file, target)
}

/// Lets the temporary `file`, which is whole, take the place of `target`.
fn put_in_place(file: NamedTempFile, target: &Path) -> io::Result<()> {
    if let Ok(before) = fs::metadata(target) {
        keep_owner_and_mode(file.as_file(), &before)?;
    }
    file.persist(target).map_err(|error| error.error)?;
    Ok(())
}

/// A temporary file with the mode of any new file, whose name ends with `suffix`.
fn temporary_file(folder: &Path, suffix: &str) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.suffix(suffix);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The umask is subtracted from this mode.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Copies the mode of the file `before` to its replacement, and the owner where this is permitted.
fn keep_owner_and_mode(file: &File, before: &fs::Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let now = file.metadata()?;
        if (now.uid(), now.gid()) != (before.uid(), before.gid()) {
            // Only root may change the owner. Failing here must not prevent the file from being written.
            let _ = fchown(file, Some(before.uid()), Some(before.gid()));
        }
    }
    file.set_permissions(before.permissions())
}
