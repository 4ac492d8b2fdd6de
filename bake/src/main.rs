//! The `bake` program. Exit code 0: done; 1: a budget or a claim was missed; 2: bad usage or input.

mod cli;
mod commands;
mod progress;

use cli::{Cli, Command};
use commands::{CommandError, Outcome};
use std::io;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match Cli::read() {
        Ok(cli) => cli,
        Err(line) => {
            eprintln!("bake: {line}");
            return ExitCode::from(2);
        }
    };
    let outcome = match cli.command {
        None => commands::bake::run(&cli.bake),
        Some(Command::Inspect { file }) => commands::inspect::run(&file),
        Some(Command::Convert { from, to }) => commands::convert::run(&from, &to),
        Some(Command::Query(args)) => commands::query::run(&args),
        Some(Command::Diff(args)) => commands::diff::run(&args),
        Some(Command::Chart(args)) => commands::chart::run(&args),
        Some(Command::Stability(args)) => commands::stability::run(&args),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::BudgetMissed | Outcome::ClaimMissed) => ExitCode::from(1),
        Err(error) if error.is_broken_pipe() => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("bake: {error}");
            ExitCode::from(2)
        }
    }
}

impl CommandError {
    /// Whether the reader of our output has gone, as `head` does: no error of the user's.
    fn is_broken_pipe(&self) -> bool {
        matches!(self, CommandError::Stdout(e) if e.kind() == io::ErrorKind::BrokenPipe)
    }
}
