//! `viewer diff`: lookup against direct integration on the device at hand, and both against the closed
//! form on the CPU.

use super::{CommandError, gpu, least, scene};
use crate::cli::DiffArgs;
use glam::DVec3;
use lensbake_core::Fate;
use lensbake_report::{Outcome, Progress};
use std::io::{self, Write};
use viewer::cpu;
use viewer::diff::{PictureDifference, Reference, TraceStatistics};
use viewer::gpu::Renderer;
use viewer::heat_map;
use viewer::picture::Picture;
use viewer::scene::{Method, Scene};
use viewer::sky::{self, Sky};

pub fn run(args: &DiffArgs) -> Result<Outcome, CommandError> {
    least::check_budget(args.budget_px)?;
    Picture::check_path(&args.output)?;
    let step = args.scene.view.step;
    let direct = scene(&args.scene, Method::Direct { step })?;
    let mut lut = direct.by(Method::Lut);
    let sky = sky::load(&args.scene.view.sky)?;
    let gpu = gpu(args.scene.device)?;
    let reference = with_progress(&lut, |progress| Reference::new(&lut, || progress.step()));
    if args.explain || args.least {
        let choice = least::choice(&lut, args.budget_px, gpu.as_ref())?;
        if args.explain {
            least::print(&choice, &lut, step)?;
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
    heat_map::write(&args.output, lut.picture.width(), &apart, &title)?;
    eprintln!("wrote {}", args.output.display());

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
    let mut text = format!(
        "{device}: {} x {} pixels, {} degrees across, r = {}, direct steps of {step} rad\n",
        lut.picture.width(),
        lut.picture.height(),
        args.scene.view.fov,
        args.scene.view.radius,
    );
    let mut missed = false;
    for (index, (what, errors)) in rows.iter().enumerate() {
        let Some(statistics) = TraceStatistics::of(errors) else {
            text += &format!("{what:21} no pixel sees the sky: the shadow fills the picture\n");
            continue;
        };
        text += &format!(
            "{what:21} rad  {}\n{:21} px   {}   other fate: {} pixels\n",
            statistics.radians, "", statistics.pixels, statistics.other_fates
        );
        missed |= index == 0 && statistics.pixels.max > args.budget_px;
    }
    let picture = PictureDifference::of(&lut.picture, &direct.picture);
    text += &format!(
        "pictures of lookup and direct, 8 bits a channel: max {}, mean {:.2e}, {} pixels off by more than 2\n",
        picture.max, picture.mean, picture.over_two
    );
    io::stdout()
        .write_all(text.as_bytes())
        .map_err(CommandError::Stdout)?;
    if missed {
        eprintln!(
            "viewer: the lookup's error is above the budget of {} px",
            args.budget_px
        );
        return Ok(Outcome::Missed);
    }
    Ok(Outcome::Done)
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
