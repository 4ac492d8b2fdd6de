//! What a command prints as its result.

use std::io::{self, Write};
use thiserror::Error;

/// Standard output that could not be written to.
#[derive(Debug, Error)]
#[error("standard output: {0}")]
pub struct PrintError(io::Error);

/// Prints the result of a command. A failure stops nothing: files are still to be written, and
/// [`Printer::finish`] tells of it at the end. A reader that has gone, as `head` does, is no failure.
#[derive(Debug)]
pub struct Printer {
    to_stderr: bool,
    reader_gone: bool,
    failure: Option<io::Error>,
}

impl Printer {
    /// To standard output; to standard error where data take standard output (`--csv -`).
    pub fn new(data_on_standard_output: bool) -> Self {
        Printer {
            to_stderr: data_on_standard_output,
            reader_gone: false,
            failure: None,
        }
    }

    /// Prints `text`, which ends with a line break, at once.
    pub fn print(&mut self, text: &str) {
        if !self.is_read() {
            return;
        }
        if self.to_stderr {
            crate::message(text.trim_end());
            return;
        }
        let mut stdout = io::stdout().lock();
        match stdout
            .write_all(text.as_bytes())
            .and_then(|()| stdout.flush())
        {
            Ok(()) => (),
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => self.reader_gone = true,
            Err(error) => self.failure = Some(error),
        }
    }

    /// Whether anyone still gets what is printed.
    pub fn is_read(&self) -> bool {
        !self.reader_gone && self.failure.is_none()
    }

    /// Tells whether all could be printed, as far as anyone read it.
    ///
    /// # Errors
    /// [`PrintError`] with the first failure.
    pub fn finish(self) -> Result<(), PrintError> {
        self.failure.map_or(Ok(()), |error| Err(PrintError(error)))
    }
}
