//! `viewer render`: a picture to a file.

use super::{CommandError, gpu_for, least, scene, spare_inputs, star_field};
use crate::cli::{DeviceName, MethodName, RenderArgs, SamplingName, ViewArgs};
use lensbake_report::{Outcome, Printer, Progress, message};
use lensbake_tables::output::Output;
use std::path::Path;
use std::time::Instant;
use viewer::cpu;
use viewer::filtered::Pixels;
use viewer::gpu::{Gpu, GpuError, Renderer};
use viewer::model::DEFAULT_BUDGET_PX;
use viewer::picture::{Picture, PictureFormat, WithoutValue};
use viewer::scene::{Method, Sampling, Scene};
use viewer::sky::{self, Sky};
use viewer::stars::{self, StarField, StarSource};

pub fn run(args: &RenderArgs) -> Result<Outcome, CommandError> {
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
    let file = PictureFile::new(&args.output, &args.scene.view, args.stars.stars.as_ref())?;
    let mut scene = scene(&args.scene, method)?.sampled(sampling);
    let sky = sky::load(&args.scene.view.sky)?;
    let stars = star_field(&args.stars, &args.scene.view.sky)?;
    let gpu = gpu_for(args.scene.device, &scene.camera)?;
    let mut printer = Printer::new(file.output.is_standard_output());
    let mut outcome = Outcome::Done;
    if args.explain || args.budget_px.is_some() {
        let choice = least::choice(&scene, budget_px, gpu.as_ref())?;
        if args.explain {
            least::print(&choice, &scene, args.scene.view.step, &mut printer);
        }
        if args.budget_px.is_some() {
            if choice.chosen.is_none() {
                outcome = Outcome::Missed;
            }
            scene = least::scene_of(choice, &scene);
        }
    }
    let started = Instant::now();
    let (picture, device) = draw(gpu, args.scene.device, &scene, &sky, stars.as_ref())?;
    let seconds = started.elapsed().as_secs_f64();
    file.write(&picture, args.exposure)?;
    message!("drawn on {device} in {seconds:.3} s");
    if scene.sampling == Sampling::Filtered {
        message!("{}", extra_rays(&scene));
    }
    message!("wrote {}", file.output.name());
    if let Some(lost) = picture.without_value() {
        say_lost(lost, &picture, scene.method);
        outcome = Outcome::Missed;
    }
    printer.finish()?;
    Ok(outcome)
}

/// The file of a picture, checked before the work.
struct PictureFile {
    format: PictureFormat,
    output: Output,
}

impl PictureFile {
    /// `path`, which is none of the files that `view` and `stars` are read from.
    fn new(path: &Path, view: &ViewArgs, stars: Option<&StarSource>) -> Result<Self, CommandError> {
        let format = PictureFormat::of(path, PictureFormat::ALL)?;
        let output = Output::binary(path)?;
        spare_inputs(&output, view, stars)?;
        Ok(PictureFile { format, output })
    }

    fn write(&self, picture: &Picture, exposure: f32) -> Result<(), CommandError> {
        let bytes = picture.encode(self.format, exposure)?;
        Ok(self.output.write(&bytes)?)
    }
}

/// Says which pixels are black because their light could not be computed.
fn say_lost(lost: WithoutValue, picture: &Picture, method: Method) {
    let WithoutValue { count, first } = lost;
    let advice = match method {
        Method::Direct { .. } => "; try a shorter --step",
        Method::Lut | Method::Flat => "",
    };
    message!(
        "viewer: the light of {count} of {} pixels could not be computed, and they are black; the first is \
         in column {}, row {}{advice}",
        picture.pixels().len(),
        first.0,
        first.1,
    );
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

/// Draws `scene` on the GPU, if there is one, else on the CPU; returns the picture and where it was drawn.
/// Stars that the GPU has no room for are drawn on the CPU unless the GPU was asked for.
fn draw(
    gpu: Option<Gpu>,
    asked_for: DeviceName,
    scene: &Scene,
    sky: &Sky,
    stars: Option<&StarField>,
) -> Result<(Picture, String), CommandError> {
    if let Some(gpu) = gpu {
        match on_gpu(&gpu, scene, sky, stars) {
            Err(CommandError::Gpu(GpuError::TooManyStars)) if asked_for == DeviceName::Auto => {
                message!(
                    "viewer: drawing on the CPU: the GPU has no room for so many images of stars"
                );
            }
            drawn => return Ok((drawn?, gpu.name())),
        }
    }
    Ok((on_cpu(scene, sky, stars)?, "the CPU".into()))
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
