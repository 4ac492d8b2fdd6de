//! How a program ends.

use std::fmt::Display;
use std::process::ExitCode;

/// How a command that could do its work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// All done.
    Done,
    /// Done, but an error is larger than was allowed, or a claim does not hold; the command said so.
    Missed,
}

impl Outcome {
    /// The exit code of `program` after its command ended so: 0 done, 1 missed, 2 bad usage or input,
    /// said in one line on standard error.
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
