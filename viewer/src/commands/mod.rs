//! The commands: arguments in, data to standard output, summaries to standard error.

pub mod bench;
pub mod catalogue;
pub mod chart;
pub mod diff;
pub mod flicker;
mod least;
pub mod reference;
pub mod render;
pub mod window;

use crate::cli::{DeviceName, SceneArgs, StarArgs, ViewArgs};
use lensbake_core::CoreError;
use lensbake_report::drawing::DrawError;
use lensbake_report::{PrintError, message};
use lensbake_tables::output::{Output, OutputError};
use lensbake_tables::{ContainerError, Table, container, default_atlas};
use std::borrow::Cow;
use std::path::PathBuf;
use thiserror::Error;
use viewer::bench::BenchError;
use viewer::camera::{Camera, CameraError};
use viewer::chart::ChartError;
use viewer::flicker::FlickerError;
use viewer::gpu::{Gpu, GpuError};
use viewer::model::Precision;
use viewer::picture::PictureError;
use viewer::reference::StudyError;
use viewer::scene::{Method, Scene, SceneError};
use viewer::sky::{SkyError, SkySource};
use viewer::stars::{self, MAX_DISC_RADIUS, StarField, StarSource, StarsError};
use viewer::window::WindowError;

/// Why a command could not do its work.
#[derive(Debug, Error)]
pub enum CommandError {
    /// The view makes no camera.
    #[error("{}: {_0}", flag_of(_0))]
    Camera(#[from] CameraError),
    /// A table file.
    #[error(transparent)]
    Container(#[from] ContainerError),
    /// The table does not serve the camera.
    #[error("{name}: {problem}")]
    Scene {
        /// The table.
        name: String,
        /// What is wrong.
        problem: SceneError,
    },
    /// The sky.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The stars.
    #[error(transparent)]
    Stars(#[from] StarsError),
    /// The radius of the stars.
    #[error("--star-radius {0} is not above 0 and at most {MAX_DISC_RADIUS} rad")]
    StarRadius(f64),
    /// An observer without a view angle.
    #[error(transparent)]
    Observer(#[from] CoreError),
    /// The GPU.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The chart.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The study of the filter.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The flicker of stars.
    #[error(transparent)]
    Flicker(#[from] FlickerError),
    /// The window.
    #[error(transparent)]
    Window(#[from] WindowError),
    /// The benchmark.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// A file to write.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A figure.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// Figures that do not go into JSON.
    #[error("JSON: {0}")]
    Json(serde_json::Error),
    /// A length of time that is none.
    #[error("--seconds {0} is not from 0 to 3600")]
    Seconds(f64),
    /// A budget that is none.
    #[error("--budget-px {0} is not a positive number of pixels")]
    Budget(f64),
    /// Standard output.
    #[error(transparent)]
    Print(#[from] PrintError),
    /// The report and the data would be mixed.
    #[error("{0} - would mix the picture with the report on standard output; name a file")]
    ReportTakesOutput(&'static str),
}

/// The flag whose value makes no camera.
fn flag_of(error: &CameraError) -> String {
    match error {
        CameraError::Radius(_) | CameraError::TooFar(_) => "--radius".into(),
        CameraError::FieldOfView(_) => "--fov".into(),
        CameraError::Angle { what, .. } => format!("--{what}"),
        CameraError::Size { .. } => "--size".into(),
    }
}

/// Checks that `output` goes over none of the files that `view` and `stars` are read from.
fn spare_inputs(
    output: &Output,
    view: &ViewArgs,
    stars: Option<&StarSource>,
) -> Result<(), OutputError> {
    let table = view.table.iter().map(PathBuf::as_path);
    let sky = view.sky.files().iter().map(PathBuf::as_path);
    let stars = match stars {
        Some(StarSource::File(path)) => Some(path.as_path()),
        Some(StarSource::Hipparcos) | None => None,
    };
    table
        .chain(sky)
        .chain(stars)
        .try_for_each(|input| output.spares(input))
}

/// The scene that the arguments describe.
fn scene(args: &SceneArgs, method: Method) -> Result<Scene, CommandError> {
    let camera = Camera::new(&args.view.view(args.size))?;
    let (table, name) = table(&args.view)?;
    Scene::new(camera, &table, method).map_err(|problem| match problem {
        SceneError::Step { .. } => CommandError::Scene {
            name: "--step".into(),
            problem,
        },
        _ => CommandError::Scene { name, problem },
    })
}

/// The stars asked for, if any: the sky `stars` has those of Hipparcos unless others are named.
fn star_field(args: &StarArgs, sky: &SkySource) -> Result<Option<StarField>, CommandError> {
    let built_in = (*sky == SkySource::Stars).then_some(StarSource::Hipparcos);
    let source = args.stars.clone().or(built_in);
    source.map(|source| stars_of(args, &source)).transpose()
}

/// The stars of a source, as bright and as large as the arguments say.
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

/// The table that the arguments name, and what it is called.
fn table(args: &ViewArgs) -> Result<(Cow<'static, Table>, String), CommandError> {
    Ok(match &args.table {
        Some(path) => (
            Cow::Owned(container::read(path)?),
            path.display().to_string(),
        ),
        None => (Cow::Borrowed(default_atlas()), "the built-in atlas".into()),
    })
}

/// The GPU to draw on, or `None` for the CPU.
fn gpu(device: DeviceName) -> Result<Option<Gpu>, GpuError> {
    match device {
        DeviceName::Cpu => Ok(None),
        DeviceName::Gpu => Gpu::open().map(Some),
        DeviceName::Auto => match Gpu::open() {
            Ok(gpu) => Ok(Some(gpu)),
            // What a person has set and misspelt is not passed over.
            Err(error @ GpuError::Backend { .. }) => Err(error),
            Err(error) => {
                message!("viewer: drawing on the CPU: {error}");
                Ok(None)
            }
        },
    }
}

/// Rounding of 32-bit floats that may be seen, pixels.
const VISIBLE_ROUNDING_PX: f64 = 0.5;

/// The GPU to draw the picture of `camera` on, or `None` for the CPU. Where the pixels are so narrow that
/// the GPU's 32-bit floats cannot tell them apart, `auto` is the CPU, and `gpu` says how far off it may be.
fn gpu_for(device: DeviceName, camera: &Camera) -> Result<Option<Gpu>, GpuError> {
    let off = Precision::F32.rounding_px(camera);
    if off > VISIBLE_ROUNDING_PX {
        match device {
            DeviceName::Cpu => {}
            DeviceName::Gpu => message!(
                "viewer: the 32-bit floats of a GPU may be off by {off:.1} pixels in so narrow a field of \
                 view; --device cpu draws it in 64 bits"
            ),
            DeviceName::Auto => {
                message!(
                    "viewer: drawing on the CPU: the 32-bit floats of a GPU would be off by up to {off:.1} \
                     pixels in so narrow a field of view"
                );
                return Ok(None);
            }
        }
    }
    gpu(device)
}
