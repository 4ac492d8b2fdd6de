//! `viewer render`: draws a picture to a file.

use super::metadata::{self, TableFacts};
use super::{CommandError, gpu_for, least, lens_of, renderer, spare_inputs, star_field, table};
use crate::cli::{DeviceName, Exposure, LayerName, MethodName, RenderArgs, SamplingName};
use clap::ValueEnum;
use lensbake_program::output::Output;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_render::camera::Camera;
use lensbake_render::filter::FilteredPixels;
use lensbake_render::gpu::{GpuError, Renderer};
use lensbake_render::layers::{self, Channel, Layer};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::model::DEFAULT_BUDGET_PX;
use lensbake_render::openexr;
use lensbake_render::picture::{Picture, PictureFormat, WithoutValue};
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::Rendition;
use lensbake_render::sky;
use lensbake_render::{cpu, exposure};
use pollster::block_on;
use std::time::Instant;

pub fn run(args: &RenderArgs) -> Result<Outcome, CommandError> {
    let method = match args.method {
        MethodName::Lut => Deflection::Lut,
        MethodName::Direct => Deflection::Direct {
            step: args.scene.view.step,
        },
        MethodName::Flat => Deflection::Flat,
    };
    let budget_px = args.budget_px.unwrap_or(DEFAULT_BUDGET_PX);
    least::check_budget(budget_px)?;
    check_device(args, args.scene.device == DeviceName::Cpu)?;
    let file = PictureFile::new(args)?;
    let camera = Camera::new(&args.scene.view.view(args.scene.size))?;
    let (table, table_name) = table(&args.scene.view)?;
    let mut lens = lens_of(camera, &table, table_name.clone(), method)?;
    let table = TableFacts::new(table_name, table.header(), &lens);
    let sky = sky::load(&args.scene.view.sky)?;
    let stars = star_field(&args.stars, &args.scene.view.sky)?;
    let gpu = gpu_for(args.scene.device, &lens.camera)?;
    check_device(args, gpu.is_none())?;
    let renderer = gpu
        .as_ref()
        .map(|gpu| renderer(gpu, args.pass))
        .transpose()?;
    let mut printer = Printer::new(file.output.is_standard_output());
    let mut outcome = Outcome::Done;
    if args.explain || args.budget_px.is_some() {
        let choice = least::choice(&lens, budget_px, gpu.as_ref())?;
        if args.explain {
            least::print(&choice, &lens, args.scene.view.step, &mut printer);
        }
        if args.budget_px.is_some() {
            if choice.chosen.is_none() {
                outcome = Outcome::Missed;
            }
            lens = least::lens_of(choice, &lens);
        }
    }
    let (rendition, exposure) = exposed(args, &lens, file.format);
    let scene = Scene {
        lens,
        sampling: args.sampling.into(),
        sky: sky.into(),
        stars: stars.map(Into::into),
        rendition,
    };
    let started = Instant::now();
    let (picture, device) = draw(renderer, args.scene.device, &scene)?;
    let seconds = started.elapsed().as_secs_f64();
    let bytes = match file.format {
        PictureFormat::Png => picture.encode(file.format, exposure)?,
        PictureFormat::OpenExr => {
            let layers = layers(&args.aov, &scene);
            openexr::encode(&picture, layers, &metadata::of(args, &table, &device)?)?
        }
    };
    file.output.write(&bytes)?;
    message!("drawn on {device} in {seconds:.3} s");
    if scene.sampling.averages() {
        message!("{}", extra_rays(&scene.lens));
    }
    message!("wrote {}", file.output.name());
    if let Some(lost) = picture.without_value() {
        report_lost_pixels(lost, &picture, scene.lens.deflection);
        outcome = Outcome::Missed;
    }
    printer.finish()?;
    Ok(outcome)
}

/// Checks that the CPU is not asked for what only a GPU has.
fn check_device(args: &RenderArgs, on_cpu: bool) -> Result<(), CommandError> {
    if !on_cpu {
        return Ok(());
    }
    if args.sampling == SamplingName::Anisotropic {
        return Err(CommandError::AnisotropicOnCpu);
    }
    match args.pass.and_then(|pass| pass.to_possible_value()) {
        Some(pass) => Err(CommandError::PassOnCpu(pass.get_name().to_owned())),
        None => Ok(()),
    }
}

/// The rendition of the picture, and the exposure of its file in stops. Automatic exposure is part of the rendition of a
/// .png; an .exr keeps all light.
fn exposed(args: &RenderArgs, lens: &Lens, format: PictureFormat) -> (Rendition, f32) {
    let shift = args.scene.view.shift.into();
    match args.exposure {
        Exposure::Stops(stops) => (Rendition::of(shift), stops),
        Exposure::Automatic if format == PictureFormat::OpenExr => (Rendition::of(shift), 0.0),
        Exposure::Automatic => {
            let stops = exposure::automatic(lens, shift);
            message!("automatic exposure: {stops:.1} stops");
            let light_scale = stops.exp2();
            (Rendition { shift, light_scale }, 0.0)
        }
    }
}

/// The output file of a picture, checked before the picture is drawn.
struct PictureFile {
    format: PictureFormat,
    output: Output,
}

impl PictureFile {
    /// The output file of `args`; an error if its format is unknown or cannot hold their layers, or if it is one of their
    /// input files.
    fn new(args: &RenderArgs) -> Result<Self, CommandError> {
        let format = PictureFormat::of(&args.output, PictureFormat::ALL)?;
        if format != PictureFormat::OpenExr && !args.aov.is_empty() {
            return Err(CommandError::LayersNeedExr(args.output.clone()));
        }
        let output = Output::binary(&args.output)?;
        spare_inputs(&output, &args.scene.view, args.stars.stars.as_ref())?;
        if let Some(like) = &args.like {
            output.spares(like)?;
        }
        Ok(PictureFile { format, output })
    }
}

/// The channels of the layers `names` of `scene`.
fn layers(names: &[LayerName], scene: &Scene) -> Vec<Channel> {
    let layers: Vec<Layer> = names.iter().flat_map(|name| name.layers()).collect();
    let progress = Progress::new("tracing layers", scene.lens.camera.height.into());
    let channels = layers::trace(&scene.lens, &layers, scene.sampling, || progress.step());
    progress.finish();
    channels
}

/// Reports the pixels that are black because their light could not be computed.
fn report_lost_pixels(lost: WithoutValue, picture: &Picture, method: Deflection) {
    let WithoutValue { count, first } = lost;
    let advice = match method {
        Deflection::Direct { .. } => "; try a shorter --step",
        Deflection::Lut | Deflection::Flat => "",
    };
    message!(
        "viewer: the light of {count} of {} pixels could not be computed, and they are black; the first is \
         in column {}, row {}{advice}",
        picture.pixels().len(),
        first.0,
        first.1,
    );
}

/// The number of extra rays for the pixels beside the shadow's edge, as text.
fn extra_rays(lens: &Lens) -> String {
    let camera = &lens.camera;
    let pixels = FilteredPixels::new(lens, Rendition::default());
    let extra = cpu::by_pixel(camera, || (), |column, row| pixels.extra_rays(column, row));
    let extra: u64 = extra.into_iter().map(u64::from).sum();
    let percent = 100.0 * extra as f64 / camera.pixels() as f64;
    format!("{extra} extra rays beside the shadow's edge, {percent:.2} % of one per pixel")
}

/// Draws `scene` on the GPU if there is one, else on the CPU; returns the picture and the name of the device. If
/// the GPU has no room for all images of stars, draws on the CPU instead, unless the user asked for the GPU.
fn draw(
    renderer: Option<Renderer>,
    asked_for: DeviceName,
    scene: &Scene,
) -> Result<(Picture, String), CommandError> {
    if let Some(renderer) = renderer {
        let on_cpu = asked_for == DeviceName::Auto && scene.sampling != Sampling::Anisotropic;
        match on_gpu(&renderer, scene) {
            Err(GpuError::TooManyStars) if on_cpu => {
                message!(
                    "viewer: drawing on the CPU: the GPU has no room for so many images of stars"
                );
            }
            drawn => return Ok((drawn?, renderer.gpu().name())),
        }
    }
    Ok((on_cpu(scene), "the CPU".into()))
}

fn on_gpu(renderer: &Renderer, scene: &Scene) -> Result<Picture, GpuError> {
    let progress = Progress::new("drawing", scene.lens.camera.height.into());
    let picture = renderer.picture(scene, |rows| progress.reach(rows.into()));
    let picture = block_on(picture)?;
    progress.finish();
    Ok(picture)
}

fn on_cpu(scene: &Scene) -> Picture {
    let progress = Progress::new("drawing", scene.lens.camera.height.into());
    let picture = cpu::render(scene, || progress.step());
    progress.finish();
    picture
}
