//! `viewer diff`: compares table lookup with direct integration on the chosen device, and both with the closed
//! form on the CPU.

use super::{CommandError, gpu_for, least, lens_of, spare_inputs, table};
use crate::cli::{DiffArgs, ProjectionArgs};
use glam::DVec3;
use lensbake_core::RayOutcome;
use lensbake_program::output::Output;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_render::camera::{Camera, Projection};
use lensbake_render::cpu;
use lensbake_render::diff::{PictureDifference, Reference, TraceStatistics};
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::{Picture, PictureFormat};
use lensbake_render::scene::Scene;
use lensbake_render::sky::{self, Sky};
use lensbake_studies::heat_map;
use pollster::block_on;
use std::sync::Arc;

pub fn run(args: &DiffArgs) -> Result<Outcome, CommandError> {
    least::check_budget(args.budget_px)?;
    let output = heat_map_file(args)?;
    let scene = &args.scene;
    let step = scene.view.light.step;
    let size = scene
        .size
        .unwrap_or(ProjectionArgs::default().default_size());
    let view = scene.view.view(size, Projection::Perspective);
    let (table, name) = table(&scene.view.light)?;
    let camera = Camera::new(&view)?;
    let direct = lens_of(camera, &table, &name, Deflection::Direct { step })?;
    let mut lut = direct.with_deflection(Deflection::Lut);
    let sky = Arc::new(sky::load(&args.scene.view.light.sky)?);
    let gpu = gpu_for(args.scene.device, &lut.camera)?;
    let mut printer = Printer::new(false);
    let reference = with_progress(&lut, |progress| Reference::new(&lut, || progress.step()));
    if args.explain || args.least {
        let choice = least::choice(&lut, None, args.budget_px, gpu.as_ref())?;
        if args.explain {
            least::print(&choice, &lut, step, &mut printer);
        }
        if args.least {
            lut = least::lens_of(choice, &lut);
        }
    }
    let (lut, direct, device) = match &gpu {
        Some(gpu) => {
            let renderer = Renderer::new(gpu);
            (
                on_gpu(&renderer, &lut, &sky)?,
                on_gpu(&renderer, &direct, &sky)?,
                gpu.name(),
            )
        }
        None => (on_cpu(&lut, &sky), on_cpu(&direct, &sky), "the CPU".into()),
    };
    let apart = reference.errors(&lut.trace, &direct.trace);
    let title = format!("lookup against direct integration on {device}");
    // If the heat map cannot be written, the report is still printed; the error is returned afterwards.
    let written = heat_map::png(lut.picture.width(), &apart, &title)
        .map_err(CommandError::from)
        .and_then(|bytes| Ok(output.write(&bytes)?));
    let closed = reference.trace();
    let rows = [
        (
            "lookup - closed form",
            reference.errors(&lut.trace, &closed),
        ),
        (
            "direct - closed form",
            reference.errors(&direct.trace, &closed),
        ),
        ("lookup - direct", apart),
    ];
    let statistics = rows.map(|(what, errors)| (what, TraceStatistics::of(&errors)));
    printer.print(&format!(
        "{device}: {} x {} pixels, {} degrees across, r = {}, direct steps of {step} rad\n{}{}",
        lut.picture.width(),
        lut.picture.height(),
        view.fov_deg,
        view.radius,
        statistics.iter().map(line).collect::<String>(),
        pictures_line(&PictureDifference::of(&lut.picture, &direct.picture)),
    ));
    written?;
    message!("wrote {}", output.name());
    printer.finish()?;
    Ok(outcome(&statistics, args.budget_px))
}

/// The output file of the heat map; an error if it is one of the scene's input files.
fn heat_map_file(args: &DiffArgs) -> Result<Output, CommandError> {
    PictureFormat::of(&args.output, &[PictureFormat::Png])?;
    let output = Output::new(&args.output)?;
    if output.is_standard_output() {
        return Err(CommandError::ReportTakesOutput("--output"));
    }
    spare_inputs(&output, &args.scene.view.light, None)?;
    Ok(output)
}

/// Name of a difference and its statistics; `None` if no pixel sees the sky.
type Difference = (&'static str, Option<TraceStatistics>);

fn line((what, statistics): &Difference) -> String {
    let Some(statistics) = statistics else {
        return format!("{what:21} no pixel sees the sky: the shadow fills the picture\n");
    };
    let no_value = match statistics.no_value {
        0 => String::new(),
        count => format!("   no value: {count} pixels"),
    };
    format!(
        "{what:21} rad  {}\n{:21} px   {}   outcome differs: {} pixels{no_value}\n",
        statistics.radians, "", statistics.pixels, statistics.differing_outcomes
    )
}

fn pictures_line(difference: &PictureDifference) -> String {
    format!(
        "pictures of lookup and direct, 8 bits a channel: max {}, mean {:.2e}, {} pixels off by more than 2\n",
        difference.max, difference.mean, difference.over_two
    )
}

/// Whether the lookup's error against the closed form, the first of the differences, is within the budget.
fn outcome(statistics: &[Difference], budget_px: f64) -> Outcome {
    match statistics.first().and_then(|(_, statistics)| *statistics) {
        Some(statistics) if statistics.pixels.max <= budget_px => return Outcome::Done,
        Some(_) => message!("viewer: the lookup's error is above the budget of {budget_px} px"),
        None => message!("viewer: no pixel sees the sky, so that no error was measured"),
    }
    Outcome::Missed
}

/// A scene drawn by one method.
struct Drawn {
    picture: Picture,
    trace: Vec<RayOutcome<DVec3>>,
}

fn on_gpu(renderer: &Renderer, lens: &Lens, sky: &Arc<Sky>) -> Result<Drawn, CommandError> {
    let scene = Scene::new(lens.clone(), sky.clone());
    let picture = with_progress(lens, |p| {
        block_on(renderer.picture(&scene, |rows| p.reach(rows.into())))
    })?;
    let trace = with_progress(lens, |p| {
        block_on(renderer.trace(lens, |rows| p.reach(rows.into())))
    })?;
    Ok(Drawn { picture, trace })
}

fn on_cpu(lens: &Lens, sky: &Arc<Sky>) -> Drawn {
    let scene = Scene::new(lens.clone(), sky.clone());
    let picture = with_progress(lens, |progress| cpu::render(&scene, || progress.step()));
    let trace = with_progress(lens, |progress| cpu::trace(lens, || progress.step()));
    Drawn { picture, trace }
}

fn with_progress<T>(lens: &Lens, work: impl FnOnce(&Progress) -> T) -> T {
    let progress = Progress::new("comparing", lens.camera.height.into());
    let answer = work(&progress);
    progress.finish();
    answer
}
