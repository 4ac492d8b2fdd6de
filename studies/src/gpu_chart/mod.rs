//! Chart of speed against accuracy on the current GPU: every method draws the same picture, in one run.

mod contenders;
pub mod csv;
pub mod figure;

pub use contenders::{Contender, Family, contenders, drawings, falling, formats};

use crate::gpu_time::{FrameTimes, interleaved};
use lensbake_render::camera::CameraError;
use lensbake_render::diff::{Reference, TraceStatistics};
use lensbake_render::gpu::{GpuError, Renderer};
use lensbake_render::lens::{Lens, LensError};
use lensbake_render::model::Cost;
use lensbake_render::scene::Scene;
use lensbake_render::sky::Sky;
use std::sync::Arc;
use thiserror::Error;

/// How much to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Workload {
    /// Rounds of timing; each round times every method once.
    pub rounds: u32,
}

impl Workload {
    /// For a chart to be kept.
    pub const FULL: Workload = Workload { rounds: 15 };
    /// For a quick check that the program works.
    pub const QUICK: Workload = Workload { rounds: 3 };
}

/// Measurements of one method.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredDeflection {
    /// Name within the family.
    pub name: String,
    /// Family of methods.
    pub family: Family,
    /// Cost by count.
    pub cost: Cost,
    /// Time per ray.
    pub times: FrameTimes,
    /// Error against the closed form.
    pub errors: TraceStatistics,
}

impl MeasuredDeflection {
    /// Time per ray, ns: by the GPU's timestamps, or by the wall clock without them.
    pub fn ns(&self) -> f64 {
        self.times.best().ns
    }
}

/// Measurements of all methods on one adapter.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Name of the adapter.
    pub adapter: String,
    /// Whether the adapter is software on the CPU, whose times are not those of a GPU.
    pub software: bool,
    /// Size of the picture, pixels.
    pub size: (u32, u32),
    /// Radius of the camera, units of r_s.
    pub radius: f64,
    /// Rounds of timing.
    pub rounds: u32,
    /// The methods.
    pub entries: Vec<MeasuredDeflection>,
}

/// Why a chart cannot be measured.
#[derive(Debug, Error)]
pub enum ChartError {
    /// The GPU failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A contender cannot be drawn.
    #[error(transparent)]
    Lens(#[from] LensError),
    /// A contender has no camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The picture shows only the hole.
    #[error("the picture shows nothing but the hole: there is no error to measure")]
    NoSky,
}

/// How many times [`measure`] calls `step`, for a progress bar.
pub fn steps(workload: Workload, contenders: usize) -> u64 {
    u64::from(workload.rounds) + contenders as u64
}

/// The renderer in the kind of pass of `contender`.
fn renderer_of(renderer: &Renderer, contender: &Contender) -> Renderer {
    match contender.pass {
        Some(pass) => renderer.clone().in_pass(pass),
        None => renderer.clone(),
    }
}

/// Measures all `contenders` on the picture of `sky` through `lens`, whose row must be the table's; a contender with
/// another camera on its own picture. `step` is
/// called after the errors of each contender and after each round of timing.
///
/// # Errors
/// [`ChartError`] if the GPU fails, or the picture shows no sky.
pub async fn measure(
    renderer: &Renderer,
    lens: &Lens,
    sky: &Arc<Sky>,
    contenders: Vec<Contender>,
    workload: Workload,
    step: impl Fn(),
) -> Result<Chart, ChartError> {
    let mut reference = Reference::new(lens, || ());
    let mut truth = reference.trace();
    let mut camera = lens.camera;
    let mut errors = Vec::new();
    for contender in &contenders {
        if contender.lens.camera != camera {
            camera = contender.lens.camera;
            reference = Reference::new(&contender.lens, || ());
            truth = reference.trace();
        }
        let renderer = renderer_of(renderer, contender);
        let trace = renderer.trace(&contender.lens, |_| ()).await?;
        let statistics = TraceStatistics::of(&reference.errors(&trace, &truth));
        errors.push(statistics.ok_or(ChartError::NoSky)?);
        step();
    }
    let mut prepared = Vec::new();
    for contender in &contenders {
        let renderer = renderer_of(renderer, contender);
        let scene = Scene::new(contender.lens.clone(), sky.clone());
        let scene = scene.with_sampling(contender.sampling);
        prepared.push(renderer.prepare(&renderer.upload(&scene).await?));
    }
    let gpu = renderer.gpu();
    let rays = lens.camera.pixels();
    let times = interleaved(gpu, &prepared, rays, workload.rounds, step).await?;
    let measured = contenders.into_iter().zip(times).zip(errors);
    Ok(Chart {
        adapter: gpu.name(),
        software: gpu.is_software(),
        size: (lens.camera.width, lens.camera.height),
        radius: lens.camera.observer.radius(),
        rounds: workload.rounds,
        entries: measured
            .map(|((contender, times), errors)| MeasuredDeflection {
                name: contender.name,
                family: contender.family,
                cost: Cost::of(&contender.lens),
                times,
                errors,
            })
            .collect(),
    })
}
