//! `viewer diff`: lookup against direct integration on the device at hand, and both against the closed
//! form on the CPU.

use super::{CommandError, gpu_for, least, scene, spare_inputs};
use crate::cli::DiffArgs;
use glam::DVec3;
use lensbake_core::Fate;
use lensbake_report::{Outcome, Printer, Progress, message};
use lensbake_tables::output::Output;
use viewer::cpu;
use viewer::diff::{PictureDifference, Reference, TraceStatistics};
use viewer::gpu::Renderer;
use viewer::heat_map;
use viewer::picture::{Picture, PictureFormat};
use viewer::scene::{Method, Scene};
use viewer::sky::{self, Sky};

pub fn run(args: &DiffArgs) -> Result<Outcome, CommandError> {
    least::check_budget(args.budget_px)?;
    let output = heat_map_file(args)?;
    let step = args.scene.view.step;
    let direct = scene(&args.scene, Method::Direct { step })?;
    let mut lut = direct.by(Method::Lut);
    let sky = sky::load(&args.scene.view.sky)?;
    let gpu = gpu_for(args.scene.device, &lut.camera)?;
    let mut printer = Printer::new(false);
    let reference = with_progress(&lut, |progress| Reference::new(&lut, || progress.step()));
    if args.explain || args.least {
        let choice = least::choice(&lut, args.budget_px, gpu.as_ref())?;
        if args.explain {
            least::print(&choice, &lut, step, &mut printer);
        }
        if args.least {
            lut = least::scene_of(choice, &lut);
        }
    }
    let (lut, direct, device) = match &gpu {
        Some(gpu) => {
            let renderer = Renderer::new(gpu, &sky)?;
            (
                on_gpu(&renderer, &lut)?,
                on_gpu(&renderer, &direct)?,
                gpu.name(),
            )
        }
        None => (on_cpu(&lut, &sky), on_cpu(&direct, &sky), "the CPU".into()),
    };
    let apart = reference.errors(&lut.trace, &direct.trace);
    let title = format!("lookup against direct integration on {device}");
    // What fails of heat map and report keeps nothing of the rest from the user.
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
        args.scene.view.fov,
        args.scene.view.radius,
        statistics.iter().map(line).collect::<String>(),
        pictures_line(&PictureDifference::of(&lut.picture, &direct.picture)),
    ));
    written?;
    message!("wrote {}", output.name());
    printer.finish()?;
    Ok(outcome(&statistics, args.budget_px))
}

/// The file of the heat map, which is none of the files that the scene is read from.
fn heat_map_file(args: &DiffArgs) -> Result<Output, CommandError> {
    PictureFormat::of(&args.output, &[PictureFormat::Png])?;
    let output = Output::new(&args.output)?;
    if output.is_standard_output() {
        return Err(CommandError::ReportTakesOutput("--output"));
    }
    spare_inputs(&output, &args.scene.view, None)?;
    Ok(output)
}

/// A difference and what it comes to; none if no pixel sees the sky.
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
        "{what:21} rad  {}\n{:21} px   {}   other fate: {} pixels{no_value}\n",
        statistics.radians, "", statistics.pixels, statistics.other_fates
    )
}

fn pictures_line(difference: &PictureDifference) -> String {
    format!(
        "pictures of lookup and direct, 8 bits a channel: max {}, mean {:.2e}, {} pixels off by more than 2\n",
        difference.max, difference.mean, difference.over_two
    )
}

/// Whether the lookup keeps its budget against the closed form, the first of the differences.
fn outcome(statistics: &[Difference], budget_px: f64) -> Outcome {
    match statistics.first().and_then(|(_, statistics)| *statistics) {
        Some(statistics) if statistics.pixels.max <= budget_px => return Outcome::Done,
        Some(_) => message!("viewer: the lookup's error is above the budget of {budget_px} px"),
        None => message!("viewer: no pixel sees the sky, so that no error was measured"),
    }
    Outcome::Missed
}

/// A scene drawn one way.
struct Drawn {
    picture: Picture,
    trace: Vec<Fate<DVec3>>,
}

fn on_gpu(renderer: &Renderer, scene: &Scene) -> Result<Drawn, CommandError> {
    let picture = with_progress(scene, |p| {
        renderer.picture(scene, |rows| p.reach(rows.into()))
    })?;
    let trace = with_progress(scene, |p| {
        renderer.trace(scene, |rows| p.reach(rows.into()))
    })?;
    Ok(Drawn { picture, trace })
}

fn on_cpu(scene: &Scene, sky: &Sky) -> Drawn {
    let picture = with_progress(scene, |progress| {
        cpu::render(scene, sky, || progress.step())
    });
    let trace = with_progress(scene, |progress| cpu::trace(scene, || progress.step()));
    Drawn { picture, trace }
}

fn with_progress<T>(scene: &Scene, work: impl FnOnce(&Progress) -> T) -> T {
    let progress = Progress::new("comparing", scene.camera.height.into());
    let answer = work(&progress);
    progress.finish();
    answer
}
