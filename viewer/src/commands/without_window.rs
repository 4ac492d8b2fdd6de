//! `viewer` without a command where there can be no window: draws the picture that the window would show first.

use super::{CommandError, render};
use crate::cli::{
    DeviceName, DrawingArgs, Exposure, MethodName, PICTURE, ProjectionArgs, RenderArgs,
    SamplingName, SceneArgs, WindowArgs,
};
use lensbake_program::{Outcome, message};

/// Says why there is no window, and draws to [`PICTURE`].
pub fn run(args: &WindowArgs, why: &str) -> Result<Outcome, CommandError> {
    message!("viewer: no window can be opened here ({why}); drawing to {PICTURE} instead");
    render::run(&first_picture(args))
}

/// Options of `render` for the picture that the window would show first.
fn first_picture(args: &WindowArgs) -> RenderArgs {
    RenderArgs {
        output: PICTURE.into(),
        budget_px: None,
        explain: false,
        aov: Vec::new(),
        like: None,
        recorded: None,
        drawing: DrawingArgs {
            method: MethodName::Lut,
            sampling: SamplingName::Filtered,
            pass: args.pass,
            exposure: Exposure::Stops(0.0),
            projection: ProjectionArgs::default(),
        },
        scene: SceneArgs {
            size: Some(args.size),
            device: DeviceName::Auto,
            view: args.view.clone(),
        },
        stars: args.stars.clone(),
        disc: args.disc.clone(),
    }
}
