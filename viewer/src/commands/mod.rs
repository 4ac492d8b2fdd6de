//! The commands: arguments in, data to standard output, summaries to standard error.

pub mod bench;
pub mod catalogue;
pub mod chart;
pub mod diff;
pub mod film;
pub mod flicker;
mod least;
mod metadata;
mod opening;
pub mod reference;
pub mod render;
#[cfg(feature = "window")]
pub mod window;
pub mod without_window;

use crate::cli::{
    DiscArgsError, DrawingArgs, LayerNeedsDisc, LightArgs, PassName, SamplingName, StarArgs,
};
use clap::ValueEnum;
use lensbake_core::CoreError;
use lensbake_film::PathFileError;
use lensbake_program::PrintError;
use lensbake_program::output::{Output, OutputError};
use lensbake_render::camera::{Camera, CameraError};
use lensbake_render::gpu::{Gpu, GpuError, Renderer};
use lensbake_render::lens::{Deflection, Lens, LensError};
use lensbake_render::picture::PictureError;
use lensbake_render::sky::{SkyError, SkySource};
use lensbake_render::stars::{self, MAX_DISC_RADIUS, StarField, StarSource, StarsError};
use lensbake_studies::bench::BenchError;
use lensbake_studies::figure::drawing::DrawError;
use lensbake_studies::flicker::FlickerError;
use lensbake_studies::gpu_chart::ChartError;
use lensbake_studies::reference::StudyError;
use lensbake_tables::{ContainerError, Table, container, default_atlas};
use opening::{gpu, gpu_for};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use thiserror::Error;
#[cfg(feature = "window")]
use viewer::window::WindowError;

/// Why a command failed.
#[derive(Debug, Error)]
pub enum CommandError {
    /// The view is not a valid camera.
    #[error("{}: {_0}", flag_of(_0))]
    Camera(#[from] CameraError),
    /// There can be no such disc.
    #[error(transparent)]
    Disc(#[from] DiscArgsError),
    /// A table file cannot be read.
    #[error(transparent)]
    Container(#[from] ContainerError),
    /// The table cannot be used for the camera, or the step is out of range.
    #[error("{name}: {problem}")]
    Lens {
        /// Name of the table or flag.
        name: String,
        /// What is wrong.
        problem: LensError,
    },
    /// The sky cannot be loaded.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The stars cannot be loaded.
    #[error(transparent)]
    Stars(#[from] StarsError),
    /// The angular radius of the stars is out of range.
    #[error("--star-radius {0} is not above 0 and at most {MAX_DISC_RADIUS} rad")]
    StarRadius(f64),
    /// The observer has no view angle.
    #[error(transparent)]
    Observer(#[from] CoreError),
    /// There is no GPU, or it failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The picture cannot be encoded, or its file has an unknown format.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The chart failed.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The study of the filter failed.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The study of flicker failed.
    #[error(transparent)]
    Flicker(#[from] FlickerError),
    /// A path of the camera cannot be read.
    #[error(transparent)]
    Path(#[from] PathFileError),
    /// The film cannot be made.
    #[error(transparent)]
    Film(#[from] film::FilmError),
    /// The window failed.
    #[cfg(feature = "window")]
    #[error(transparent)]
    Window(#[from] WindowError),
    /// The benchmark failed.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// An output file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A figure cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The results cannot be encoded as JSON.
    #[error("JSON: {0}")]
    Json(serde_json::Error),
    /// The duration is out of range.
    #[error("--seconds {0} is not from 0 to 3600")]
    Seconds(f64),
    /// The budget is not a positive number.
    #[error("--budget-px {0} is not a positive number of pixels")]
    Budget(f64),
    /// The CPU has no anisotropic filter.
    #[error(
        "--sampling anisotropic needs a GPU, whose filter it is; on the CPU use --sampling filtered"
    )]
    AnisotropicOnCpu,
    /// No view of a disc has the text in its name.
    #[error("--only {0}: no view has this in its name; leave it out to see the names of all")]
    NoSuchView(String),
    /// An option does not go with the projection.
    #[error("{0}")]
    Projection(&'static str),
    /// The names of the six faces of a cube cannot be made of the output's.
    #[error("--output: {}: the six faces of a cube need a file name like cube.png", _0.display())]
    FacesOutput(PathBuf),
    /// The CPU draws in no passes.
    #[error("--pass {0} needs a GPU; leave it out to draw on the CPU")]
    PassOnCpu(String),
    /// The GPU has no compute shaders.
    #[error("--pass compute: the GPU {0} has no compute shaders; use --pass fragment")]
    NoCompute(String),
    /// Only an OpenEXR file holds layers.
    #[error("--aov: {} holds no layers; name an .exr with --output", _0.display())]
    LayersNeedExr(PathBuf),
    /// Only a picture with a disc has the layers of one.
    #[error(transparent)]
    LayerNeedsDisc(#[from] LayerNeedsDisc),
    /// Standard output cannot be written.
    #[error(transparent)]
    Print(#[from] PrintError),
    /// The picture and the report would both go to standard output.
    #[error("{0} - would mix the picture with the report on standard output; name a file")]
    ReportTakesOutput(&'static str),
}

/// The flag whose value `error` refuses.
fn flag_of(error: &CameraError) -> String {
    match error {
        CameraError::Radius(_) | CameraError::TooFar(_) => "--radius".into(),
        CameraError::FieldOfView(_) | CameraError::DiscFieldOfView(_) => "--fov".into(),
        CameraError::Tilt(_) => "--tilt".into(),
        CameraError::Angle { what, .. } => format!("--{what}"),
        CameraError::Size { .. } | CameraError::Shape { .. } => "--size".into(),
    }
}

/// Checks that `output` overwrites none of the input files of `light` and `stars`.
fn spare_inputs(
    output: &Output,
    light: &LightArgs,
    stars: Option<&StarSource>,
) -> Result<(), OutputError> {
    let table = light.table.iter().map(PathBuf::as_path);
    let sky = light.sky.files().iter().map(PathBuf::as_path);
    let stars = match stars {
        Some(StarSource::File(path)) => Some(path.as_path()),
        Some(StarSource::Hipparcos) | None => None,
    };
    table
        .chain(sky)
        .chain(stars)
        .try_for_each(|input| output.spares(input))
}

/// The path of one of several pictures: the name of the file with an ending before its extension.
fn named(path: &Path, ending: &str) -> Result<PathBuf, CommandError> {
    let (Some(stem), Some(extension)) = (path.file_stem(), path.extension()) else {
        return Err(CommandError::FacesOutput(path.to_owned()));
    };
    let mut name = stem.to_owned();
    name.push("_");
    name.push(ending);
    name.push(".");
    name.push(extension);
    Ok(path.with_file_name(name))
}

/// The lens of `camera` with `table`, whose name in messages is `name`.
fn lens_of(
    camera: Camera,
    table: &Table,
    name: &str,
    deflection: Deflection,
) -> Result<Lens, CommandError> {
    Lens::new(camera, table, deflection).map_err(|problem| match problem {
        LensError::Step { .. } => CommandError::Lens {
            name: "--step".into(),
            problem,
        },
        _ => CommandError::Lens {
            name: name.to_owned(),
            problem,
        },
    })
}

/// The stars that the arguments ask for before this sky, if any.
fn star_field(args: &StarArgs, sky: &SkySource) -> Result<Option<StarField>, CommandError> {
    let source = args.source(sky);
    source.map(|source| stars_of(args, &source)).transpose()
}

/// The stars of `source`, with the exposure and angular radius that the arguments give.
fn stars_of(args: &StarArgs, source: &StarSource) -> Result<StarField, CommandError> {
    let mut field = StarField::new(&stars::load(source)?, args.star_exposure);
    if let Some(radius) = args.star_radius {
        if !(radius > 0.0 && radius <= MAX_DISC_RADIUS) {
            return Err(CommandError::StarRadius(radius));
        }
        field.disc_radius = radius;
    }
    Ok(field)
}

/// The table that the arguments name, or the built-in atlas, with its name for messages.
fn table(args: &LightArgs) -> Result<(Cow<'static, Table>, String), CommandError> {
    Ok(match &args.table {
        Some(path) => (
            Cow::Owned(container::read(path)?),
            path.display().to_string(),
        ),
        None => (Cow::Borrowed(default_atlas()), "the built-in atlas".into()),
    })
}

/// Checks that the CPU is not asked for what only a GPU has.
fn check_device(drawing: &DrawingArgs, on_cpu: bool) -> Result<(), CommandError> {
    if !on_cpu {
        return Ok(());
    }
    if drawing.sampling == SamplingName::Anisotropic {
        return Err(CommandError::AnisotropicOnCpu);
    }
    match drawing.pass.and_then(|pass| pass.to_possible_value()) {
        Some(pass) => Err(CommandError::PassOnCpu(pass.get_name().to_owned())),
        None => Ok(()),
    }
}

/// A renderer that draws in `pass`, if one is asked for.
fn renderer(gpu: &Gpu, pass: Option<PassName>) -> Result<Renderer, CommandError> {
    let renderer = Renderer::new(gpu);
    let Some(pass) = pass else {
        return Ok(renderer);
    };
    let renderer = renderer.in_pass(pass.into());
    if pass == PassName::Compute && !gpu.has_compute() {
        return Err(CommandError::NoCompute(gpu.name()));
    }
    Ok(renderer)
}
