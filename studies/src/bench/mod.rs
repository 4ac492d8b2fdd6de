//! The benchmark: every contender draws the same flight at several sizes, some filtered and with stars; all take
//! turns in one run.
//!
//! The flight is that of the bholetrace report of 2022: the radius oscillates between 2.5 and 37.5 with elapsed
//! time, and every frame is prepared and drawn as in the window.

mod contender;
mod errors;
pub mod figure;
mod measured;
pub mod report;

pub use contender::{CONTENDERS, Contender};
pub use measured::Measured;

use crate::gpu_time::{FrameTime, Timer};
use lensbake_core::Motion;
use lensbake_render::camera::{Camera, CameraError, View};
use lensbake_render::disc::Disc;
use lensbake_render::gpu::{
    FrameContent, GpuError, Pass, RealtimeRenderer, Renderer, SkyOnDevice, StarsOnDevice,
};
use lensbake_render::lens::{Deflection, Lens, LensError};
use lensbake_render::scene::Scene;
use lensbake_render::shift::Rendition;
use lensbake_render::sky::Sky;
use lensbake_render::stars::StarField;
use lensbake_tables::Table;
use std::f64::consts::TAU;
use std::time::{Duration, Instant};
use thiserror::Error;

/// Nearest and farthest radius of the flight.
pub const RADII: (f64, f64) = (2.5, 37.5);
/// Sizes of the picture, pixels.
pub const SIZES: [(u32, u32); 4] = [(480, 270), (960, 540), (1920, 1080), (3840, 2160)];
/// Frames of each contender drawn before timing starts: the first dispatch may still compile shaders.
const WARM_UP: u32 = 2;

/// The kinds of passes, in the order of `Flight::realtimes`.
const PASSES: [Pass; 2] = [Pass::Compute, Pass::Fragment];

/// How much to measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Workload {
    /// Sizes of the picture, pixels.
    pub sizes: Vec<(u32, u32)>,
    /// Period of the radius, at each size.
    pub swing: Duration,
    /// If given, the camera stays at this radius (units of r_s) instead of flying.
    pub radius: Option<f64>,
    /// Minimum number of rounds at each size. In a round, each contender draws one frame from the same radius.
    pub rounds: u32,
}

/// One contender at one size.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredContender {
    /// Size of the picture, pixels.
    pub size: (u32, u32),
    /// The contender.
    pub contender: Contender,
    /// The kind of pass that it is drawn in.
    pub pass: Pass,
    /// Statistics of its frames.
    pub measured: Measured,
    /// T_ray (time per ray) in each round, ns; in a round all contenders draw the same radius.
    pub rounds: Vec<f64>,
}

/// Results on one adapter.
#[derive(Debug, Clone, PartialEq)]
pub struct Bench {
    /// Name of the adapter.
    pub adapter: String,
    /// Whether the adapter is software on the CPU, whose times are not those of a GPU.
    pub software: bool,
    /// Largest error of the rays of each of [`CONTENDERS`] on the flight, in image-space pixels.
    pub errors: Vec<f64>,
    /// Measurements by size, then by contender.
    pub entries: Vec<MeasuredContender>,
}

/// Why a benchmark cannot be run.
#[derive(Debug, Error)]
pub enum BenchError {
    /// The GPU failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A size is not valid for a camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The camera cannot use the table.
    #[error(transparent)]
    Lens(#[from] LensError),
    /// A size exceeds the largest texture of the adapter.
    #[error("{width}x{height} pixels are more than the adapter draws to: {most} a side")]
    TooLarge {
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// Largest width and height of the adapter.
        most: u32,
    },
}

/// Runs the benchmark before `sky`, some contenders with `stars`. `round_done` is called after each round with the
/// fraction that is done.
///
/// # Errors
/// [`BenchError`] if the GPU fails, or a size makes no picture.
pub async fn run(
    renderer: &Renderer,
    sky: &Sky,
    stars: &StarField,
    table: &Table,
    workload: &Workload,
    round_done: impl Fn(f64),
) -> Result<Bench, BenchError> {
    let gpu = renderer.gpu().clone();
    let most = gpu.device.limits().max_texture_dimension_2d;
    for &(width, height) in &workload.sizes {
        if width.max(height) > most {
            return Err(BenchError::TooLarge {
                width,
                height,
                most,
            });
        }
        // The motion that asks most of the radius.
        let radius = workload.radius.unwrap_or(RADII.1);
        Camera::new(&view(radius, Motion::Orbit, (width, height)))?;
    }
    let errors = errors::largest(renderer, table).await?;
    let mut flight = Flight {
        timer: Timer::new(&gpu),
        table,
        sky: renderer.upload_sky(sky).await?,
        stars: renderer.upload_stars(stars),
        renderer,
        realtimes: PASSES.map(|pass| {
            let renderer = renderer.clone().in_pass(pass);
            RealtimeRenderer::new(renderer, [1, 1])
        }),
    };
    let mut entries = Vec::new();
    for (i, &size) in workload.sizes.iter().enumerate() {
        let done = |part: f64| round_done((i as f64 + part) / workload.sizes.len() as f64);
        let frames = flight.fly(size, workload, done).await?;
        let rays = size.0 as usize * size.1 as usize;
        let entry = |(contender, frames): (_, &Vec<FrameTime>)| MeasuredContender {
            size,
            contender,
            pass: contender.pass(renderer),
            measured: Measured::of(frames, rays),
            rounds: frames.iter().map(|frame| frame.ns_per_ray(rays)).collect(),
        };
        entries.extend(CONTENDERS.into_iter().zip(&frames).map(entry));
    }
    Ok(Bench {
        adapter: gpu.name(),
        software: gpu.is_software(),
        errors,
        entries,
    })
}

/// The flight on one device.
struct Flight<'a> {
    timer: Timer<'a>,
    table: &'a Table,
    sky: SkyOnDevice,
    stars: StarsOnDevice,
    renderer: &'a Renderer,
    /// For each kind of pass.
    realtimes: [RealtimeRenderer; PASSES.len()],
}

impl Flight<'_> {
    /// The times of the frames of each contender at one size.
    async fn fly(
        &mut self,
        size: (u32, u32),
        workload: &Workload,
        round_done: impl Fn(f64),
    ) -> Result<Vec<Vec<FrameTime>>, BenchError> {
        for realtime in &mut self.realtimes {
            realtime.set_room([size.0, size.1]);
        }
        for contender in CONTENDERS {
            for _ in 0..WARM_UP {
                self.frame(contender, RADII.1, size).await?;
            }
        }
        let mut frames = vec![Vec::new(); CONTENDERS.len()];
        let started = Instant::now();
        let mut rounds = 0;
        while rounds < workload.rounds || started.elapsed() < workload.swing {
            let flown = radius(started.elapsed().div_duration_f64(workload.swing));
            let radius = workload.radius.unwrap_or(flown);
            for (contender, frames) in CONTENDERS.into_iter().zip(&mut frames) {
                frames.push(self.frame(contender, radius, size).await?);
            }
            rounds += 1;
            let by_time = started.elapsed().div_duration_f64(workload.swing);
            let by_rounds = f64::from(rounds) / f64::from(workload.rounds);
            round_done(by_time.min(by_rounds).min(1.0));
        }
        Ok(frames)
    }

    /// Draws a frame and returns its time. The wall-clock time includes all that a frame takes: preparation on the
    /// CPU, submission to the GPU, and drawing to the end.
    async fn frame(
        &mut self,
        contender: Contender,
        radius: f64,
        size: (u32, u32),
    ) -> Result<FrameTime, BenchError> {
        let started = Instant::now();
        let scene = Scene {
            lens: lens(self.table, radius, contender.motion, size)?
                .with_deflection(contender.deflection),
            sampling: contender.sampling,
            sky: self.sky.clone(),
            stars: contender.stars.then(|| self.stars.clone()),
            rendition: Rendition::default(),
            disc: contender.disc.then(Disc::default),
        };
        let pass = usize::from(contender.pass(self.renderer) == Pass::Fragment);
        let realtime = &mut self.realtimes[pass];
        realtime.show(&scene, FrameContent::Picture);
        let gpu = self.timer.time(realtime).await?.gpu;
        let wall = started.elapsed();
        Ok(FrameTime { gpu, wall })
    }
}

/// The radius after `swings` periods; it starts at the farthest.
fn radius(swings: f64) -> f64 {
    let (near, far) = RADII;
    0.5 * (near + far) + 0.5 * (far - near) * (TAU * swings).cos()
}

fn view(radius: f64, motion: Motion, (width, height): (u32, u32)) -> View {
    View {
        radius,
        motion,
        width,
        height,
        ..View::default()
    }
}

fn lens(table: &Table, radius: f64, motion: Motion, size: (u32, u32)) -> Result<Lens, BenchError> {
    let camera = Camera::new(&view(radius, motion, size))?;
    Ok(Lens::new(camera, table, Deflection::Lut)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_swings_there_and_back() {
        assert_eq!(radius(0.0), 37.5);
        assert!((radius(0.5) - 2.5).abs() < 1e-12);
        assert!((radius(1.0) - 37.5).abs() < 1e-12);
        assert!((radius(0.25) - 20.0).abs() < 1e-12);
    }
}
