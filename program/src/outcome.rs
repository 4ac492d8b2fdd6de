//! The outcome of a command and the exit code of its program.

use std::fmt::Display;
use std::process::ExitCode;

/// The outcome of a command that could do its work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// All done.
    Done,
    /// Done, but an error is larger than allowed or a claim does not hold, which the command has reported.
    Missed,
}

impl Outcome {
    /// The exit code of `program` for the result of its command: 0 done, 1 missed, 2 bad usage or input. An error
    /// is printed in one line on standard error.
    pub fn end(program: &str, ended: Result<Outcome, impl Display>) -> ExitCode {
        match ended {
            Ok(Outcome::Done) => ExitCode::SUCCESS,
            Ok(Outcome::Missed) => ExitCode::from(1),
            Err(error) => {
                crate::message!("{program}: {error}");
                ExitCode::from(2)
            }
        }
    }
}
