//! `viewer film`: draws the frames of a film, to files or to a video.

mod camera;
mod error;
mod files;
mod latent;
mod pipeline;
mod plan;
mod target;
mod video;

pub use error::FilmError;

use super::{CommandError, check_device, gpu_for, renderer, star_field, table};
use crate::cli::{DeviceName, FilmArgs};
use camera::FilmCamera;
use lensbake_program::output;
use lensbake_program::{Outcome, message};
use lensbake_render::camera::Camera;
use lensbake_render::sky;
use lensbake_render::stars::SortedStars;
use pipeline::Summary;
use plan::Plan;
use target::Target;

pub fn run(args: &FilmArgs) -> Result<Outcome, CommandError> {
    let plan = Plan::new(args)?;
    if let Some(file) = &args.save_path {
        output::write(file, plan.path.to_json().as_bytes())?;
        message!("wrote {}", file.display());
        return Ok(Outcome::Done);
    }
    check_device(&args.drawing, args.device == DeviceName::Cpu)?;
    let narrowest = narrowest_camera(&plan)?;
    let (target, frames) = Target::new(args, &plan)?;
    let skipped = plan.frames.len() - frames.len();
    if frames.is_empty() {
        message!("all {skipped} frames exist already; --overwrite draws them anew");
        return Ok(Outcome::Done);
    }
    let (table, table_name) = table(&args.light)?;
    let mut camera = FilmCamera {
        plan: &plan,
        table: &table,
        table_name: &table_name,
        deflection: args.drawing.method.with_step(args.light.step),
        sampling: args.drawing.sampling.into(),
        shift: args.light.shift.into(),
        exposure: args.drawing.exposure,
        keeps_light: target.keeps_light(),
        sky: sky::load(&args.light.sky)?.into(),
        renderer: None,
    };
    camera.check(&frames)?;
    let stars = star_field(&args.stars, &args.light.sky)?.map(SortedStars::new);
    let gpu = gpu_for(args.device, &narrowest)?;
    check_device(&args.drawing, gpu.is_none())?;
    let renderer = gpu.as_ref().map(|gpu| renderer(gpu, args.drawing.pass));
    camera.renderer = renderer.transpose()?;
    let summary = pipeline::expose(&camera, &frames, stars.as_ref(), &target)?;
    target.finish()?;
    message!("{}", report(&camera.device(), &summary, skipped));
    message!("wrote {}", target.name());
    Ok(outcome(&summary))
}

/// The camera of the film with the narrowest pixels, which decides whether a GPU is accurate enough: that of all frames, so
/// that every part of the film is drawn on the same device.
fn narrowest_camera(plan: &Plan) -> Result<Camera, CommandError> {
    let camera = |frame| Camera::new(&plan.shot(frame).view);
    let mut narrowest = camera(0)?;
    for frame in 1..plan.clock.frames() {
        let other = camera(frame)?;
        if other.right.length() < narrowest.right.length() {
            narrowest = other;
        }
    }
    Ok(narrowest)
}

/// One line: how many frames were drawn, and where the time went.
fn report(device: &str, summary: &Summary, skipped: usize) -> String {
    let wall = summary.wall.as_secs_f64();
    let share = |time: std::time::Duration| 100.0 * time.as_secs_f64() / wall;
    let an_hour = 3600.0 * f64::from(summary.frames) / wall;
    format!(
        "drawn on {device}: {} frames, {skipped} skipped, in {wall:.1} s ({an_hour:.0} frames an hour); drawing and \
         reading back took {:.0} % of the time, encoding {:.0} % in {}",
        summary.frames,
        share(summary.drawing),
        share(summary.encoding),
        match summary.threads {
            1 => "one thread beside it".to_owned(),
            threads => format!("{threads} threads beside it, added up"),
        }
    )
}

fn outcome(summary: &Summary) -> Outcome {
    let Some((frame, lost)) = summary.first_lost else {
        return Outcome::Done;
    };
    message!(
        "viewer: the light of {} pixels of frame {frame} could not be computed, and they are black; this is the first \
         such frame",
        lost.count
    );
    Outcome::Missed
}
