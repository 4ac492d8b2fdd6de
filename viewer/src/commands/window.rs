//! `viewer`: the window, or the picture that it would show where there can be none.

use super::{CommandError, render, stars_of, table};
use crate::cli::{
    DeviceName, MethodName, PICTURE, RenderArgs, SamplingName, SceneArgs, WindowArgs,
};
use lensbake_report::{Outcome, message};
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
    let ended = window::run(Options {
        view,
        step,
        sky: args.view.sky.clone(),
        stars,
        stars_everywhere: args.stars.stars.is_some(),
        table: table.into_owned(),
        table_name,
        fullscreen: args.fullscreen,
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

/// The picture of what the window would show first.
fn instead(args: &WindowArgs) -> RenderArgs {
    RenderArgs {
        output: PICTURE.into(),
        method: MethodName::Lut,
        sampling: SamplingName::Filtered,
        exposure: 0.0,
        budget_px: None,
        explain: false,
        scene: SceneArgs {
            size: args.size,
            device: DeviceName::Auto,
            view: args.view.clone(),
        },
        stars: args.stars.clone(),
    }
}
