//! The chart of speed against accuracy on the GPU at hand: the same picture by every method, in one run.

mod contenders;
pub mod csv;
pub mod figure;
mod plane;
mod timing;

pub use contenders::{Contender, Family, contenders};
pub use timing::{FrameTimes, interleaved};

use crate::diff::{Reference, TraceStatistics};
use crate::gpu::{Gpu, GpuError, Output, Prepared, Renderer};
use crate::model::Cost;
use crate::scene::{Scene, SceneError};
use thiserror::Error;

/// How much to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Rounds of timing; in each, every method has its turn.
    pub rounds: u32,
}

impl Effort {
    /// For a chart that is kept.
    pub const FULL: Effort = Effort { rounds: 15 };
    /// To see that it works.
    pub const QUICK: Effort = Effort { rounds: 3 };
}

/// One method, measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// What it is called.
    pub name: String,
    /// What it belongs to.
    pub family: Family,
    /// What it costs by count.
    pub cost: Cost,
    /// What it costs by the clock, a ray.
    pub times: FrameTimes,
    /// Its distance from the closed form.
    pub errors: TraceStatistics,
}

impl Entry {
    /// ns a ray: by the GPU's timestamps where there are any, else by the wall clock.
    pub fn ns(&self) -> f64 {
        self.times.best().ns
    }
}

/// All methods on one adapter.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The adapter.
    pub adapter: String,
    /// Whether it is the CPU in disguise, whose times are no GPU's.
    pub software: bool,
    /// Size of the picture, pixels.
    pub size: (u32, u32),
    /// Radius of the camera.
    pub radius: f64,
    /// Rounds of timing.
    pub rounds: u32,
    /// The methods.
    pub entries: Vec<Entry>,
}

/// A chart that cannot be measured.
#[derive(Debug, Error)]
pub enum ChartError {
    /// The GPU.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A contender that cannot be drawn.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A picture of nothing but the hole.
    #[error("the picture shows nothing but the hole: there is no error to measure")]
    NoSky,
}

/// Steps of a measurement, for a progress bar.
pub fn steps(effort: Effort, contenders: usize) -> u64 {
    u64::from(effort.rounds) + contenders as u64
}

/// Measures all `contenders` at drawing `scene`, whose row is the table's. `step` is called after each
/// contender's errors and each round of timing.
///
/// # Errors
/// [`ChartError`] if the GPU fails, or the picture holds no sky.
pub fn measure(
    gpu: &Gpu,
    renderer: &Renderer,
    scene: &Scene,
    contenders: Vec<Contender>,
    effort: Effort,
    step: impl Fn(),
) -> Result<Chart, ChartError> {
    let reference = Reference::new(scene, || ());
    let truth = reference.trace();
    let mut errors = Vec::new();
    for contender in &contenders {
        let trace = renderer.trace(&contender.scene, |_| ())?;
        let statistics = TraceStatistics::of(&reference.errors(&trace, &truth));
        errors.push(statistics.ok_or(ChartError::NoSky)?);
        step();
    }
    let prepared: Vec<Prepared> = contenders
        .iter()
        .map(|contender| renderer.prepare(&contender.scene, Output::Picture))
        .collect();
    let rays = scene.camera.pixels();
    let times = interleaved(gpu, &prepared, rays, effort.rounds, step)?;
    let measured = contenders.into_iter().zip(times).zip(errors);
    Ok(Chart {
        adapter: gpu.name(),
        software: gpu.is_software(),
        size: (scene.camera.width, scene.camera.height),
        radius: scene.camera.observer.radius(),
        rounds: effort.rounds,
        entries: measured
            .map(|((contender, times), errors)| Entry {
                name: contender.name,
                family: contender.family,
                cost: Cost::of(&contender.scene),
                times,
                errors,
            })
            .collect(),
    })
}
