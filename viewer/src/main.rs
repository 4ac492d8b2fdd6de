//! The `viewer` program. Exit code 0: done; 1: a budget was missed; 2: bad usage or input.

mod cli;
mod commands;
mod progress;

use cli::{Cli, Command};
use commands::Outcome;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match Cli::read() {
        Ok(cli) => cli,
        Err(line) => {
            eprintln!("viewer: {line}");
            return ExitCode::from(2);
        }
    };
    let outcome = match cli.command {
        Command::Render(args) => commands::render::run(&args),
        Command::Chart(args) => commands::chart::run(&args),
        Command::Diff(args) => commands::diff::run(&args),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::BudgetMissed) => ExitCode::from(1),
        Err(error) => {
            eprintln!("viewer: {error}");
            ExitCode::from(2)
        }
    }
}
