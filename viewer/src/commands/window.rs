//! `viewer` without a command: opens the window, or draws the picture that it would show if no window can be
//! opened.

use super::{CommandError, render, stars_of, table};
use crate::cli::{
    DeviceName, Exposure, MethodName, PICTURE, RenderArgs, SamplingName, SceneArgs, WindowArgs,
};
use lensbake_program::{Outcome, message};
use lensbake_render::camera::Camera;
use lensbake_render::lens::Deflection;
use lensbake_render::stars::StarSource;
use viewer::window::{self, Options};

pub fn run(args: &WindowArgs) -> Result<Outcome, CommandError> {
    let view = args.view.view(args.size);
    // Checked here so that the error names the flag; the window knows no flags.
    Camera::new(&view)?;
    let step = args.view.step;
    Deflection::check_step(step).map_err(|problem| CommandError::Lens {
        name: "--step".into(),
        problem,
    })?;
    // The Hipparcos stars unless others are named: the window always offers the sky `stars`.
    let source = args.stars.stars.clone();
    let stars = stars_of(&args.stars, &source.unwrap_or(StarSource::Hipparcos))?;
    let (table, table_name) = table(&args.view)?;
    let ended = window::run(Options {
        view,
        step,
        shift: args.view.shift.into(),
        sky: args.view.sky.clone(),
        stars,
        stars_everywhere: args.stars.stars.is_some(),
        table: table.into_owned(),
        table_name,
        fullscreen: args.fullscreen,
        pass: args.pass.map(Into::into),
    });
    match ended {
        Err(error) if error.is_no_window() => {
            message!(
                "viewer: no window can be opened here ({error}); drawing to {PICTURE} instead"
            );
            render::run(&instead(args))
        }
        ended => Ok(ended.map(|()| Outcome::Done)?),
    }
}

/// Options of `render` for the picture that the window would show first.
fn instead(args: &WindowArgs) -> RenderArgs {
    RenderArgs {
        output: PICTURE.into(),
        method: MethodName::Lut,
        sampling: SamplingName::Filtered,
        pass: args.pass,
        exposure: Exposure::Stops(0.0),
        budget_px: None,
        explain: false,
        aov: Vec::new(),
        like: None,
        recorded: None,
        scene: SceneArgs {
            size: args.size,
            device: DeviceName::Auto,
            view: args.view.clone(),
        },
        stars: args.stars.clone(),
    }
}
