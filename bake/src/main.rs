//! The `bake` program. Exit code 0: done; 1: a budget or a claim was missed; 2: bad usage or input.

mod cli;
mod commands;

use cli::{Cli, Command};
use lensbake_program::{Outcome, arguments};
use std::process::ExitCode;

const PROGRAM: &str = "bake";

fn main() -> ExitCode {
    let cli: Cli = match arguments::read() {
        Ok(cli) => cli,
        Err(line) => return Outcome::end(PROGRAM, Err(line)),
    };
    let outcome = match cli.command {
        None => commands::bake::run(&cli.bake),
        Some(Command::Inspect { file }) => commands::inspect::run(&file),
        Some(Command::Convert { from, to }) => commands::convert::run(&from, &to),
        Some(Command::Export(args)) => commands::export::run(&args),
        Some(Command::Query(args)) => commands::query::run(&args),
        Some(Command::Diff(args)) => commands::diff::run(&args),
        Some(Command::Chart(args)) if args.disc => commands::crossing_chart::run(&args),
        Some(Command::Chart(args)) => commands::chart::run(&args),
        Some(Command::Stability(args)) => commands::stability::run(&args),
        Some(Command::Luminet(args)) => commands::luminet::run(&args),
    };
    Outcome::end(PROGRAM, outcome)
}
