//! `viewer` without a command: opens the window, or draws the picture that it would show if no window can be
//! opened.

use super::{CommandError, stars_of, table, without_window};
use crate::cli::{StarArgs, WindowArgs};
use lensbake_program::Outcome;
use lensbake_render::camera::{Camera, Projection};
use lensbake_render::lens::Deflection;
use lensbake_render::stars::{self, StarField, StarSource};
use viewer::window::{self, Coming, Options};

pub fn run(args: &WindowArgs) -> Result<Outcome, CommandError> {
    let view = args.view.view(args.size, Projection::Perspective);
    // Checked here so that the error names the flag; the window knows no flags.
    Camera::new(&view)?;
    let disc = args.disc.disc(args.view.disc_seen_from_deg())?;
    let step = args.view.light.step;
    Deflection::check_step(step).map_err(|problem| CommandError::Lens {
        name: "--step".into(),
        problem,
    })?;
    // The Hipparcos stars unless others are named: the window always offers the sky `stars`.
    let stars = match &args.stars {
        // They cannot fail, so that the window may be opened meanwhile.
        StarArgs {
            stars: None | Some(StarSource::Hipparcos),
            star_radius: None,
            ..
        } => {
            let stops = args.stars.star_exposure;
            Coming::soon(move || StarField::new(&stars::hipparcos(), stops))
        }
        StarArgs { stars: source, .. } => {
            let source = source.clone().unwrap_or(StarSource::Hipparcos);
            Coming::Here(stars_of(&args.stars, &source)?)
        }
    };
    let path = args.play.as_deref().map(lensbake_film::read).transpose()?;
    let (table, table_name) = table(&args.view.light)?;
    let ended = window::run(Options {
        view,
        step,
        shift: args.view.light.shift.into(),
        sky: args.view.light.sky.clone(),
        stars,
        stars_everywhere: args.stars.stars.is_some(),
        disc,
        path: path.map(|(path, _)| path),
        table: table.into_owned(),
        table_name,
        fullscreen: args.fullscreen,
        pass: args.pass.map(Into::into),
    });
    match ended {
        Err(error) if error.is_no_window() => without_window::run(args, &error.to_string()),
        ended => Ok(ended.map(|()| Outcome::Done)?),
    }
}
