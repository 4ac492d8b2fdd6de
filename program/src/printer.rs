//! Prints the result of a command.

use std::io::{self, Write};
use thiserror::Error;

/// Why standard output could not be written to.
#[derive(Debug, Error)]
#[error("standard output: {0}")]
pub struct PrintError(io::Error);

/// Prints the result of a command. A failure stops nothing, because files may still have to be written;
/// [`Printer::finish`] returns it at the end. A reader that has closed the pipe, as `head` does, is not a failure.
#[derive(Debug)]
pub struct Printer {
    to_stderr: bool,
    reader_gone: bool,
    failure: Option<io::Error>,
}

impl Printer {
    /// Prints to standard output, or to standard error if data go to standard output (`--csv -`).
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

    /// Whether anyone still reads what is printed.
    pub fn is_read(&self) -> bool {
        !self.reader_gone && self.failure.is_none()
    }

    /// Reports whether printing succeeded. A reader that has closed the pipe is not a failure.
    ///
    /// # Errors
    /// [`PrintError`] with the first failure.
    pub fn finish(self) -> Result<(), PrintError> {
        self.failure.map_or(Ok(()), |error| Err(PrintError(error)))
    }
}
