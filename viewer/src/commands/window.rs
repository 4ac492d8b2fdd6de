//! `viewer`: the window.

use super::{CommandError, table};
use crate::cli::WindowArgs;
use lensbake_report::Outcome;
use viewer::scene::Method;
use viewer::window::{self, Options};

pub fn run(args: &WindowArgs) -> Result<Outcome, CommandError> {
    let step = args.view.step;
    Method::check_step(step).map_err(|problem| CommandError::Scene {
        name: "--step".into(),
        problem,
    })?;
    let (table, table_name) = table(&args.view)?;
    window::run(Options {
        view: args.view.view(args.size),
        step,
        sky: args.view.sky.clone(),
        table: table.into_owned(),
        table_name,
        fullscreen: args.fullscreen,
    })?;
    Ok(Outcome::Done)
}
