//! `viewer render`: draws a picture to a file.

use super::metadata::{self, Described, TableFacts};
use super::opening::gpu_beside;
use super::{
    CommandError, check_device, least, lens_of, named, renderer, spare_inputs, star_field, table,
};
use crate::cli::{DeviceName, Exposure, LayerName, RenderArgs};
use lensbake_program::output::Output;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_render::camera::{Camera, View};
use lensbake_render::disc::Disc;
use lensbake_render::filter::FilteredPixels;
use lensbake_render::gpu::{Gpu, GpuError, Renderer};
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
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

pub fn run(args: &RenderArgs) -> Result<Outcome, CommandError> {
    let method = args.drawing.method.with_step(args.scene.view.light.step);
    let budget_px = args.budget_px.unwrap_or(DEFAULT_BUDGET_PX);
    least::check_budget(budget_px)?;
    check_device(&args.drawing, args.scene.device == DeviceName::Cpu)?;
    let jobs = jobs(args, method)?;
    let disc = args.disc.disc(args.scene.view.disc_seen_from_deg())?;
    let light = &args.scene.view.light;
    let camera = &jobs[0].lens.camera;
    let prepare = |gpu: &Gpu| prepared(gpu, args, &jobs[0].lens, disc.as_ref());
    let load = || {
        let sky = sky::load(&light.sky)?;
        Ok::<_, CommandError>((sky, star_field(&args.stars, &light.sky)?))
    };
    let (opened, (sky, stars)) = gpu_beside(args.scene.device, camera, prepare, load)?;
    check_device(&args.drawing, opened.is_none())?;
    let (gpu, renderer) = opened.unzip();
    let renderer = renderer.transpose()?;
    let mut printer = Printer::new(jobs[0].file.output.is_standard_output());
    if jobs[0].file.format == PictureFormat::OpenExr {
        metadata::report_unrecorded(args.recorded.as_ref(), &args.output);
    }
    let (sky, stars) = (Arc::new(sky), stars.map(Arc::new));
    let mut outcome = Outcome::Done;
    let (rendition, exposure) = exposed(args, &jobs);
    for mut job in jobs {
        if args.explain || args.budget_px.is_some() {
            let choice = least::choice(&job.lens, disc, budget_px, gpu.as_ref())?;
            if args.explain {
                least::print(&choice, &job.lens, light.step, &mut printer);
            }
            if args.budget_px.is_some() {
                if choice.chosen.is_none() {
                    outcome = Outcome::Missed;
                }
                job.lens = least::lens_of(choice, &job.lens);
            }
        }
        let scene = Scene {
            lens: job.lens.clone(),
            sampling: args.drawing.sampling.into(),
            sky: sky.clone(),
            stars: stars.clone(),
            rendition,
            disc,
        };
        if !picture(args, renderer.as_ref(), &scene, &job, exposure)? {
            outcome = Outcome::Missed;
        }
    }
    printer.finish()?;
    Ok(outcome)
}

/// A renderer on `gpu` that has compiled what the picture through `lens` needs, unless another model may be chosen.
fn prepared(
    gpu: &Gpu,
    args: &RenderArgs,
    lens: &Lens,
    disc: Option<&Disc>,
) -> Result<Renderer, CommandError> {
    let renderer = renderer(gpu, args.drawing.pass)?;
    if args.budget_px.is_none() {
        let light = &args.scene.view.light;
        let stars = args.stars.source(&light.sky).is_some();
        let sampling = args.drawing.sampling.into();
        renderer.compile(lens, sampling, stars, light.shift.into(), disc);
    }
    Ok(renderer)
}

/// A picture to draw, and its file.
struct Job {
    file: PictureFile,
    view: View,
    lens: Lens,
    table: TableFacts,
}

/// The pictures that the arguments ask for: one, or the six faces of a cube.
fn jobs(args: &RenderArgs, method: Deflection) -> Result<Vec<Job>, CommandError> {
    let (projection, scene) = (args.drawing.projection, &args.scene);
    projection
        .check(scene.view.fov.is_some())
        .map_err(CommandError::Projection)?;
    let size = scene.size.unwrap_or(projection.default_size());
    let (table, name) = table(&scene.view.light)?;
    let job = |(ending, projection)| {
        let path = match ending {
            Some(ending) => named(&args.output, ending)?,
            None => args.output.clone(),
        };
        let view = scene.view.view(size, projection);
        let lens = lens_of(Camera::new(&view)?, &table, &name, method)?;
        Ok(Job {
            file: PictureFile::new(&path, args)?,
            view,
            table: TableFacts::new(name.clone(), table.header(), &lens),
            lens,
        })
    };
    projection.all().into_iter().map(job).collect()
}

/// Draws a picture and writes its file; false if the light of some pixels could not be computed.
fn picture(
    args: &RenderArgs,
    renderer: Option<&Renderer>,
    scene: &Scene,
    job: &Job,
    exposure: f32,
) -> Result<bool, CommandError> {
    let started = Instant::now();
    let (picture, device) = draw(renderer, args.scene.device, scene)?;
    let seconds = started.elapsed().as_secs_f64();
    let Job {
        file, view, table, ..
    } = job;
    let bytes = match file.format {
        PictureFormat::Png => picture.encode(file.format, exposure)?,
        PictureFormat::OpenExr => {
            let layers = channels(&file.layers, scene);
            let metadata =
                metadata::of(&described(args, scene.disc.as_ref()), view, table, &device)?;
            openexr::encode(&picture, layers, &metadata)?
        }
    };
    file.output.write(&bytes)?;
    message!("drawn on {device} in {seconds:.3} s");
    if scene.sampling.averages() {
        message!("{}", extra_rays(&scene.lens));
    }
    message!("wrote {}", file.output.name());
    let lost = picture.without_value();
    if let Some(lost) = lost {
        report_lost_pixels(lost, &picture, scene.lens.deflection);
    }
    Ok(lost.is_none())
}

/// The rendition of the pictures, and the exposure of their files in stops. Automatic exposure is part of the rendition of a
/// .png; an .exr keeps all light.
fn exposed(args: &RenderArgs, jobs: &[Job]) -> (Rendition, f32) {
    let format = jobs[0].file.format;
    let shift = args.scene.view.light.shift.into();
    match args.drawing.exposure {
        Exposure::Stops(stops) => (Rendition::of(shift), stops),
        Exposure::Automatic if format == PictureFormat::OpenExr => (Rendition::of(shift), 0.0),
        Exposure::Automatic => {
            let lenses: Vec<Lens> = jobs.iter().map(|job| job.lens.clone()).collect();
            let stops = exposure::automatic_of_all(&lenses, shift);
            message!("automatic exposure: {stops:.1} stops");
            let light_scale = stops.exp2();
            (Rendition { shift, light_scale }, 0.0)
        }
    }
}

/// The output file of a picture, checked before the picture is drawn.
struct PictureFile {
    format: PictureFormat,
    /// Its layers.
    layers: Vec<Layer>,
    output: Output,
}

impl PictureFile {
    /// The output file `path`; an error if its format is unknown or cannot hold the layers of `args`, or if it is one of
    /// their input files.
    fn new(path: &Path, args: &RenderArgs) -> Result<Self, CommandError> {
        let format = PictureFormat::of(path, PictureFormat::ALL)?;
        if format != PictureFormat::OpenExr && !args.aov.is_empty() {
            return Err(CommandError::LayersNeedExr(path.to_owned()));
        }
        let layers = LayerName::layers_of(&args.aov, &args.disc)?;
        let output = Output::binary(path)?;
        spare_inputs(&output, &args.scene.view.light, args.stars.stars.as_ref())?;
        if let Some(like) = &args.like {
            output.spares(like)?;
        }
        Ok(PictureFile {
            format,
            layers,
            output,
        })
    }
}

/// What the arguments say of the picture apart from its camera.
fn described<'a>(args: &'a RenderArgs, disc: Option<&'a Disc>) -> Described<'a> {
    Described {
        light: &args.scene.view.light,
        drawing: &args.drawing,
        stars: &args.stars,
        disc,
        budget_px: args.budget_px,
        recorded: args.recorded.as_ref(),
    }
}

/// The channels of `layers` of `scene`.
fn channels(layers: &[Layer], scene: &Scene) -> Vec<Channel> {
    let progress = Progress::new("tracing layers", scene.lens.camera.height.into());
    let row_done = || progress.step();
    let channels = layers::trace(&scene.lens, layers, scene.sampling, scene.disc, row_done);
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
    let extra = pixels.extra_rays_in_all();
    let percent = 100.0 * extra as f64 / camera.pixels() as f64;
    format!("{extra} extra rays beside the shadow's edge, {percent:.2} % of one per pixel")
}

/// Draws `scene` on the GPU if there is one, else on the CPU; returns the picture and the name of the device. If
/// the GPU has no room for all images of stars, draws on the CPU instead, unless the user asked for the GPU.
fn draw(
    renderer: Option<&Renderer>,
    asked_for: DeviceName,
    scene: &Scene,
) -> Result<(Picture, String), CommandError> {
    if let Some(renderer) = renderer {
        let on_cpu = asked_for == DeviceName::Auto && scene.sampling != Sampling::Anisotropic;
        match on_gpu(renderer, scene) {
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
