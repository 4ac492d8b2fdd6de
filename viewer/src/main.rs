//! The `viewer` program. Exit code 0: done; 1: a budget was missed; 2: bad usage or input.

mod cli;
mod commands;

use cli::Command;
use lensbake_program::Outcome;
use std::process::ExitCode;

const PROGRAM: &str = "viewer";

fn main() -> ExitCode {
    let cli = match cli::read() {
        Ok(cli) => cli,
        Err(line) => return Outcome::end(PROGRAM, Err(line)),
    };
    let outcome = match cli.command {
        #[cfg(feature = "window")]
        None => commands::window::run(&cli.window),
        #[cfg(not(feature = "window"))]
        None => commands::without_window::run(&cli.window, "this program was built without one"),
        Some(Command::Render(args)) => commands::render::run(&args),
        Some(Command::Film(args)) => commands::film::run(&args),
        Some(Command::Chart(args)) => commands::chart::run(&args),
        Some(Command::Bench(args)) => commands::bench::run(&args),
        Some(Command::Catalogue(args)) => commands::catalogue::run(&args),
        Some(Command::Diff(args)) => commands::diff::run(&args),
        Some(Command::Flicker(args)) => commands::flicker::run(&args),
        Some(Command::Reference(args)) => commands::reference::run(&args),
    };
    Outcome::end(PROGRAM, outcome)
}
