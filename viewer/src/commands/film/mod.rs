//! `viewer film`: draws the frames of a film, to files or to a video.

mod camera;
mod error;
mod files;
mod latent;
mod pipeline;
mod plan;
mod slate;
mod target;
mod video;

pub use error::FilmError;

use super::{CommandError, check_device, gpu_for, metadata, named, renderer, star_field, table};
use crate::cli::{DeviceName, DiscArgsError, FilmArgs};
use camera::FilmCamera;
use lensbake_program::output::{Output, OutputError};
use lensbake_program::{Outcome, message};
use lensbake_render::camera::Camera;
use lensbake_render::disc::{Disc, angular_velocity};
use lensbake_render::sky;
use lensbake_render::stars::SortedStars;
use pipeline::Summary;
use plan::Plan;
use slate::Slate;
use std::sync::Arc;
use target::Target;

/// Largest rate of a disc, r_s/c per second.
const MAX_DISC_RATE: f64 = 1e6;
/// Time in which the inner rim of a disc turns once in a film unless the user names its rate, s.
const SECONDS_PER_TURN: f64 = 10.0;

pub fn run(args: &FilmArgs) -> Result<Outcome, CommandError> {
    let projection = args.drawing.projection;
    projection
        .check(args.fov.is_some())
        .map_err(CommandError::Projection)?;
    // The camera flies round a disc that stays.
    let disc = args.disc.disc([0.0; 2])?;
    check_disc_rate(args)?;
    if let Some(file) = &args.save_path {
        let output = Output::new(file)?;
        spare_inputs(&output, args)?;
        output.write(Plan::new(args)?.path.to_json().as_bytes())?;
        message!("wrote {}", output.name());
        return Ok(Outcome::Done);
    }
    check_device(&args.drawing, args.device == DeviceName::Cpu)?;
    let films = projection.all().into_iter();
    let plan = Plan::new(args)?;
    let films = films.map(|(ending, projection)| Film::new(args, ending, plan.seen_in(projection)));
    let films: Vec<Film> = films.collect::<Result<_, _>>()?;
    if films.iter().all(|film| film.frames.is_empty()) {
        let skipped: usize = films.iter().map(Film::skipped).sum();
        message!("all {skipped} frames exist already; --overwrite draws them anew");
        return Ok(Outcome::Done);
    }
    let (table, table_name) = table(&args.light)?;
    let sky = Arc::new(sky::load(&args.light.sky)?);
    let stars = star_field(&args.stars, &args.light.sky)?.map(SortedStars::new);
    let gpu = gpu_for(args.device, &narrowest_camera(&films[0].plan)?)?;
    check_device(&args.drawing, gpu.is_none())?;
    let renderer = gpu.as_ref().map(|gpu| renderer(gpu, args.drawing.pass));
    let renderer = renderer.transpose()?;
    let cameras = films.iter().map(|film| FilmCamera {
        plan: &film.plan,
        table: &table,
        table_name: &table_name,
        deflection: args.drawing.method.with_step(args.light.step),
        sampling: args.drawing.sampling.into(),
        shift: args.light.shift.into(),
        exposure: args.drawing.exposure,
        keeps_light: film.target.keeps_light(),
        sky: sky.clone(),
        disc,
        disc_rate: disc_rate(args, disc.as_ref()),
        renderer: renderer.clone(),
    });
    let takes: Vec<(FilmCamera, &Film)> = cameras.zip(&films).collect();
    for (camera, film) in &takes {
        camera.check(&film.frames)?;
    }
    if films[0].target.keeps_light()
        && let Some(output) = &args.output
    {
        metadata::report_unrecorded(args.recorded.as_ref(), output);
    }
    let mut all = Outcome::Done;
    for (camera, film) in &takes {
        if film.frames.is_empty() {
            let (name, skipped) = (film.target.name(), film.skipped());
            message!("{name}: all {skipped} frames exist already");
            continue;
        }
        let slate = Slate { args, camera };
        let summary = pipeline::expose(&film.frames, stars.as_ref(), &film.target, &slate)?;
        film.target.finish()?;
        message!("{}", report(&camera.device(), &summary, film.skipped()));
        message!("wrote {}", film.target.name());
        if outcome(&summary) == Outcome::Missed {
            all = Outcome::Missed;
        }
    }
    Ok(all)
}

/// Checks that --disc-rate is a rate, and that there is a disc for it.
fn check_disc_rate(args: &FilmArgs) -> Result<(), DiscArgsError> {
    match args.disc_rate {
        None => Ok(()),
        Some(_) if args.disc.disc.is_none() => Err(DiscArgsError::NoDisc("--disc-rate")),
        Some(rate) if rate.abs() <= MAX_DISC_RATE => Ok(()),
        Some(rate) => Err(DiscArgsError::Rate(rate, MAX_DISC_RATE)),
    }
}

/// How much time of the pattern of `disc` passes in a second of the film, r_s/c. Unless the user names it, the inner rim turns
/// once in [`SECONDS_PER_TURN`].
fn disc_rate(args: &FilmArgs, disc: Option<&Disc>) -> f64 {
    let inner = disc.map_or(Disc::default().inner, |disc| disc.inner);
    let turn = std::f64::consts::TAU / angular_velocity(inner);
    args.disc_rate.unwrap_or(turn / SECONDS_PER_TURN)
}

/// A film in one projection, and its target.
struct Film {
    plan: Plan,
    target: Target,
    /// The frames that are not there yet.
    frames: Vec<u32>,
}

impl Film {
    fn new(args: &FilmArgs, ending: Option<&str>, plan: Plan) -> Result<Self, CommandError> {
        // It is missing only with --save-path, which draws nothing.
        let output = args.output.as_deref().unwrap_or("".as_ref());
        let path = match ending {
            Some(ending) => named(output, ending)?,
            None => output.to_owned(),
        };
        // The errors of the view come before those of the target.
        narrowest_camera(&plan)?;
        let (target, frames) = Target::new(&path, args, &plan)?;
        if !target.keeps_light() && !args.aov.is_empty() {
            return Err(CommandError::LayersNeedExr(path));
        }
        Ok(Film {
            plan,
            target,
            frames,
        })
    }

    /// Number of frames that exist.
    fn skipped(&self) -> usize {
        self.plan.frames.len() - self.frames.len()
    }
}

/// Checks that `output` overwrites none of the input files of `args`.
fn spare_inputs(output: &Output, args: &FilmArgs) -> Result<(), OutputError> {
    super::spare_inputs(output, &args.light, args.stars.stars.as_ref())?;
    args.file.iter().try_for_each(|path| output.spares(path))
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
