//! The benchmark: the same flight by every method at several sizes, filtered and with stars too, all taking
//! turns in one run.
//!
//! The flight is the 2022 report's: the radius swings between 2.5 and 37.5 by elapsed time, and every
//! frame is prepared and drawn as the window does it.

mod contender;
mod errors;
mod measured;
pub mod report;

pub use contender::{CONTENDERS, Contender};
pub use measured::Measured;

use crate::camera::{Camera, CameraError, View};
use crate::gpu::{FrameTime, Gpu, GpuError, Live, Renderer, Show, Timer};
use crate::scene::{Method, Scene, SceneError};
use crate::stars::StarField;
use lensbake_tables::Table;
use std::f64::consts::TAU;
use std::time::{Duration, Instant};
use thiserror::Error;

/// The nearest and the farthest of the flight.
pub const RADII: (f64, f64) = (2.5, 37.5);
/// Sizes of the picture, pixels.
pub const SIZES: [(u32, u32); 4] = [(480, 270), (960, 540), (1920, 1080), (3840, 2160)];
/// Frames of each contender that are drawn before the first counts: a first dispatch still compiles.
const WARM_UP: u32 = 2;

/// How much to measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Effort {
    /// Sizes of the picture, pixels.
    pub sizes: Vec<(u32, u32)>,
    /// One swing of the radius there and back, at each size.
    pub swing: Duration,
    /// Rounds at each size at the least; in a round each contender draws a frame from the same radius.
    pub rounds: u32,
}

/// One contender at one size.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Size of the picture, pixels.
    pub size: (u32, u32),
    /// The contender.
    pub contender: Contender,
    /// Its frames.
    pub measured: Measured,
    /// T_ray in each round, ns: all contenders draw the same radius in one.
    pub rounds: Vec<f64>,
}

/// All of it on one adapter.
#[derive(Debug, Clone, PartialEq)]
pub struct Bench {
    /// The adapter.
    pub adapter: String,
    /// Whether it is the CPU in disguise, whose times are no GPU's.
    pub software: bool,
    /// The largest error of the rays of each of [`CONTENDERS`] on the flight, in image space, pixels.
    pub errors: Vec<f64>,
    /// By size, then by contender.
    pub entries: Vec<Entry>,
}

/// A benchmark that cannot be run.
#[derive(Debug, Error)]
pub enum BenchError {
    /// The GPU.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A size.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The table.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A size beyond what the adapter draws to.
    #[error("{width}x{height} pixels are more than the adapter draws to: {most} a side")]
    TooLarge {
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// The most it can.
        most: u32,
    },
}

/// Runs the benchmark, some contenders with `stars`. `round_done` is called with the part that is done after each round.
///
/// # Errors
/// [`BenchError`] if the GPU fails, or a size makes no picture.
pub fn run(
    renderer: Renderer,
    stars: &StarField,
    table: &Table,
    effort: &Effort,
    round_done: impl Fn(f64),
) -> Result<Bench, BenchError> {
    let gpu = renderer.gpu().clone();
    let most = gpu.device.limits().max_texture_dimension_2d;
    for &(width, height) in &effort.sizes {
        if width.max(height) > most {
            return Err(BenchError::TooLarge {
                width,
                height,
                most,
            });
        }
        Camera::new(&view(RADII.1, (width, height)))?;
    }
    let errors = errors::largest(&renderer, table)?;
    let mut flight = Flight::new(&gpu, renderer, stars, table)?;
    let mut entries = Vec::new();
    for (i, &size) in effort.sizes.iter().enumerate() {
        let done = |part: f64| round_done((i as f64 + part) / effort.sizes.len() as f64);
        let frames = flight.fly(size, effort, done)?;
        let rays = size.0 as usize * size.1 as usize;
        let entry = |(contender, frames): (_, &Vec<FrameTime>)| Entry {
            size,
            contender,
            measured: Measured::of(frames, rays),
            rounds: frames.iter().map(|frame| frame.ns_a_ray(rays)).collect(),
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

/// What draws the frames.
struct Flight<'a> {
    timer: Timer<'a>,
    table: &'a Table,
    plain: Live,
    starry: Live,
}

impl<'a> Flight<'a> {
    fn new(
        gpu: &'a Gpu,
        renderer: Renderer,
        stars: &StarField,
        table: &'a Table,
    ) -> Result<Self, BenchError> {
        let steps = CONTENDERS
            .iter()
            .filter_map(|contender| match contender.method {
                Method::Direct { step } => Some(step),
                Method::Lut | Method::Flat => None,
            });
        let steps: Vec<f64> = steps.collect();
        let row = &scene(table, RADII.1, (1, 1))?.row;
        Ok(Flight {
            timer: Timer::new(gpu),
            table,
            starry: Live::new(renderer.clone().with_stars(stars), row, [1, 1], &steps),
            plain: Live::new(renderer, row, [1, 1], &steps),
        })
    }

    /// The frames of each contender at one size.
    fn fly(
        &mut self,
        size: (u32, u32),
        effort: &Effort,
        round_done: impl Fn(f64),
    ) -> Result<Vec<Vec<FrameTime>>, BenchError> {
        for live in [&mut self.plain, &mut self.starry] {
            live.set_room([size.0, size.1]);
        }
        for contender in CONTENDERS {
            for _ in 0..WARM_UP {
                self.frame(contender, RADII.1, size)?;
            }
        }
        let mut frames = vec![Vec::new(); CONTENDERS.len()];
        let started = Instant::now();
        let mut rounds = 0;
        while rounds < effort.rounds || started.elapsed() < effort.swing {
            let radius = radius(started.elapsed().div_duration_f64(effort.swing));
            for (contender, frames) in CONTENDERS.into_iter().zip(&mut frames) {
                frames.push(self.frame(contender, radius, size)?);
            }
            rounds += 1;
            let by_time = started.elapsed().div_duration_f64(effort.swing);
            let by_rounds = f64::from(rounds) / f64::from(effort.rounds);
            round_done(by_time.min(by_rounds).min(1.0));
        }
        Ok(frames)
    }

    /// A frame and its time. By the wall clock that holds all that a frame takes: its preparation on the
    /// CPU, its way to the GPU, and its drawing to the end.
    fn frame(
        &mut self,
        contender: Contender,
        radius: f64,
        size: (u32, u32),
    ) -> Result<FrameTime, BenchError> {
        let live = match contender.stars {
            true => &mut self.starry,
            false => &mut self.plain,
        };
        let started = Instant::now();
        let scene = scene(self.table, radius, size)?.by(contender.method);
        live.show(&scene.sampled(contender.sampling), Show::Picture);
        let gpu = self.timer.time(live)?.gpu;
        let wall = started.elapsed();
        Ok(FrameTime { gpu, wall })
    }
}

/// The radius after `swings` of the way from the farthest to the nearest and back.
fn radius(swings: f64) -> f64 {
    let (near, far) = RADII;
    0.5 * (near + far) + 0.5 * (far - near) * (TAU * swings).cos()
}

fn view(radius: f64, (width, height): (u32, u32)) -> View {
    View {
        radius,
        width,
        height,
        ..View::default()
    }
}

fn scene(table: &Table, radius: f64, size: (u32, u32)) -> Result<Scene, BenchError> {
    let camera = Camera::new(&view(radius, size))?;
    Ok(Scene::new(camera, table, Method::Lut)?)
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
