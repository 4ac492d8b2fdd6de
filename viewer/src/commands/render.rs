//! `viewer render`: a picture to a file.

use super::{CommandError, gpu, least, scene, star_field};
use crate::cli::{MethodName, RenderArgs, SamplingName};
use lensbake_report::{Outcome, Progress};
use std::time::Instant;
use viewer::cpu;
use viewer::filtered::Pixels;
use viewer::gpu::{Gpu, Renderer};
use viewer::model::DEFAULT_BUDGET_PX;
use viewer::picture::Picture;
use viewer::scene::{Method, Sampling, Scene};
use viewer::sky::{self, Sky};
use viewer::stars::{self, StarField};

pub fn run(args: &RenderArgs) -> Result<Outcome, CommandError> {
    Picture::check_path(&args.output)?;
    let method = match args.method {
        MethodName::Lut => Method::Lut,
        MethodName::Direct => Method::Direct {
            step: args.scene.view.step,
        },
        MethodName::Flat => Method::Flat,
    };
    let budget_px = args.budget_px.unwrap_or(DEFAULT_BUDGET_PX);
    least::check_budget(budget_px)?;
    let sampling = match args.sampling {
        SamplingName::Single => Sampling::Single,
        SamplingName::Filtered => Sampling::Filtered,
    };
    let mut scene = scene(&args.scene, method)?.sampled(sampling);
    let sky = sky::load(&args.scene.view.sky)?;
    let stars = star_field(&args.stars, &args.scene.view.sky)?;
    let gpu = gpu(args.scene.device)?;
    let mut outcome = Outcome::Done;
    if args.explain || args.budget_px.is_some() {
        let choice = least::choice(&scene, budget_px, gpu.as_ref())?;
        if args.explain {
            least::print(&choice, &scene, args.scene.view.step)?;
        }
        if args.budget_px.is_some() {
            if choice.chosen.is_none() {
                outcome = Outcome::Missed;
            }
            scene = least::scene_of(choice, &scene);
        }
    }
    let started = Instant::now();
    let picture = match &gpu {
        Some(gpu) => on_gpu(gpu, &scene, &sky, stars.as_ref())?,
        None => on_cpu(&scene, &sky, stars.as_ref())?,
    };
    let device = gpu.map_or("the CPU".into(), |gpu| gpu.name());
    eprintln!(
        "drawn on {device} in {:.3} s",
        started.elapsed().as_secs_f64()
    );
    if scene.sampling == Sampling::Filtered {
        eprintln!("{}", extra_rays(&scene));
    }
    picture.write(&args.output, args.exposure)?;
    eprintln!("wrote {}", args.output.display());
    Ok(outcome)
}

/// What the pixels beside the shadow's edge cost.
fn extra_rays(scene: &Scene) -> String {
    let camera = &scene.camera;
    let pixels = Pixels::new(scene);
    let extra = cpu::by_pixel(camera, || (), |column, row| pixels.extra_rays(column, row));
    let extra: u64 = extra.into_iter().map(u64::from).sum();
    let percent = 100.0 * extra as f64 / camera.pixels() as f64;
    format!("{extra} extra rays beside the shadow's edge, {percent:.2} % of one a pixel")
}

fn on_gpu(
    gpu: &Gpu,
    scene: &Scene,
    sky: &Sky,
    stars: Option<&StarField>,
) -> Result<Picture, CommandError> {
    let progress = Progress::new("drawing", scene.camera.height.into());
    let mut renderer = Renderer::new(gpu, sky)?;
    if let Some(stars) = stars {
        renderer = renderer.with_stars(stars);
    }
    let picture = renderer.picture(scene, |rows| progress.reach(rows.into()))?;
    progress.finish();
    Ok(picture)
}

fn on_cpu(scene: &Scene, sky: &Sky, stars: Option<&StarField>) -> Result<Picture, CommandError> {
    let progress = Progress::new("drawing", scene.camera.height.into());
    let mut picture = cpu::render(scene, sky, || progress.step());
    if let Some(stars) = stars {
        stars::draw(&mut picture, scene, stars)?;
    }
    progress.finish();
    Ok(picture)
}
