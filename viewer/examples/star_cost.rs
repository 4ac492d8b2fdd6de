//! What the Hipparcos stars cost: frames of 1920 × 1080 before the nebula without and with them in turn, on the
//! GPU at hand, and what the CPU does for each of them.

use lensbake_tables::default_atlas;
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;
use viewer::camera::{Camera, View};
use viewer::gpu::{Gpu, Output, Prepared, Renderer, Timer};
use viewer::scene::{Method, Scene};
use viewer::sky::{self, SkySource};
use viewer::stars::cells::Cells;
use viewer::stars::images::Lens;
use viewer::stars::{StarField, hipparcos};

const ROUNDS: usize = 60;

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open()?;
    let sky = sky::load(&SkySource::Nebula)?;
    let plain = Renderer::new(&gpu, &sky)?;
    let field = StarField::new(&hipparcos(), 0.0);
    let starry = Renderer::new(&gpu, &sky)?.with_stars(&field);
    let cells = Cells::new(&field);
    println!("{}, median of {ROUNDS} frames", gpu.name());
    for (radius, yaw_deg) in [(25.0, 0.0), (25.0, 90.0), (10.0, 0.0), (2.0, 90.0)] {
        let camera = Camera::new(&View {
            radius,
            yaw_deg,
            ..View::default()
        })?;
        let scene = Scene::new(camera, default_atlas(), Method::Lut)?;
        let frames = [&plain, &starry].map(|renderer| renderer.prepare(&scene, Output::Picture));
        let [without, with] = medians(&gpu, &frames)?;
        println!(
            "r = {radius}, yaw {yaw_deg}: {without:.1} ms without, {with:.1} ms with, {:.2} times",
            with / without
        );
        let (lens, inverse) = timed(|| Lens::of(&scene));
        let lens = lens?;
        let (candidates, culling) =
            timed(|| cells.candidates(&scene.camera, &lens, field.disc_radius));
        println!(
            "    on the CPU {inverse:.2} ms for the inverse row, {culling:.2} ms to leave all but {} images out",
            candidates.points.len()
        );
    }
    Ok(())
}

/// What `work` gives, and the median time that it takes, ms.
fn timed<T>(work: impl Fn() -> T) -> (T, f64) {
    let mut times = [0.0; ROUNDS];
    for time in &mut times {
        let started = Instant::now();
        black_box(work());
        *time = 1e3 * started.elapsed().as_secs_f64();
    }
    times.sort_by(f64::total_cmp);
    (work(), times[ROUNDS / 2])
}

/// The median time of each frame by the wall clock, ms; they are drawn in turn.
fn medians(gpu: &Gpu, frames: &[Prepared; 2]) -> Result<[f64; 2], Box<dyn Error>> {
    let timer = Timer::new(gpu);
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        for (frame, times) in frames.iter().zip(&mut times) {
            times.push(1e3 * timer.time(frame)?.wall.as_secs_f64());
        }
    }
    Ok(times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    }))
}
