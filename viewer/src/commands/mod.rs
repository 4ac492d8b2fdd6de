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
use lensbake_tables::{ContainerError, Table, container, default_atlas};
use std::borrow::Cow;
use std::io::{self, Write};
use std::path::PathBuf;
use thiserror::Error;
use viewer::bench::BenchError;
use viewer::camera::{Camera, CameraError};
use viewer::chart::ChartError;
use viewer::flicker::FlickerError;
use viewer::gpu::{Gpu, GpuError};
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
    #[error("{}: {_1}", _0.display())]
    File(PathBuf, io::Error),
    /// Figures that do not go into JSON.
    #[error("JSON: {0}")]
    Json(serde_json::Error),
    /// A length of time that is none.
    #[error("--seconds {0} is not from 0 to 3600")]
    Seconds(f64),
    /// A folder to write to.
    #[error("{}: {_1}", _0.display())]
    Folder(PathBuf, io::Error),
    /// A budget that is none.
    #[error("--budget-px {0} is not a positive number of pixels")]
    Budget(f64),
    /// Standard output.
    #[error("standard output: {0}")]
    Stdout(io::Error),
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

/// To standard output, as soon as it is known.
fn print(text: &str) -> Result<(), CommandError> {
    let mut stdout = io::stdout();
    stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
        .map_err(CommandError::Stdout)
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
                eprintln!("viewer: drawing on the CPU: {error}");
                Ok(None)
            }
        },
    }
}
