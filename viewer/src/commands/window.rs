//! `viewer`: the window.

use super::{CommandError, stars_of, table};
use crate::cli::WindowArgs;
use lensbake_report::Outcome;
use viewer::camera::Camera;
use viewer::scene::Method;
use viewer::stars::StarSource;
use viewer::window::{self, Options};

pub fn run(args: &WindowArgs) -> Result<Outcome, CommandError> {
    let view = args.view.view(args.size);
    // Named by its flag here; the window knows no flags.
    Camera::new(&view)?;
    let step = args.view.step;
    Method::check_step(step).map_err(|problem| CommandError::Scene {
        name: "--step".into(),
        problem,
    })?;
    // Those of Hipparcos unless others are named: the sky `stars` is one of the window's.
    let source = args.stars.stars.clone();
    let stars = stars_of(&args.stars, &source.unwrap_or(StarSource::Hipparcos))?;
    let (table, table_name) = table(&args.view)?;
    window::run(Options {
        view,
        step,
        sky: args.view.sky.clone(),
        stars,
        stars_everywhere: args.stars.stars.is_some(),
        table: table.into_owned(),
        table_name,
        fullscreen: args.fullscreen,
    })?;
    Ok(Outcome::Done)
}
