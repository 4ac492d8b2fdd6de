//! `viewer chart`: speed against accuracy of every way to draw, on the GPU at hand.

use super::CommandError;
use crate::cli::ChartArgs;
use lensbake_report::{Outcome, Progress};
use lensbake_tables::container::write_whole;
use lensbake_tables::default_atlas;
use std::fs;
use viewer::camera::{Camera, View};
use viewer::chart::{Effort, contenders, csv, figure, measure, steps};
use viewer::gpu::{Gpu, Renderer};
use viewer::scene::{Method, Scene};
use viewer::sky::{self, SkySource};

pub fn run(args: &ChartArgs) -> Result<Outcome, CommandError> {
    let (effort, default_size) = if args.quick {
        (Effort::QUICK, (320, 180))
    } else {
        (Effort::FULL, (1920, 1080))
    };
    let (width, height) = args.size.unwrap_or(default_size);
    let camera = Camera::new(&View {
        radius: args.radius,
        fov_deg: args.fov,
        width,
        height,
        ..View::default()
    })?;
    let gpu = Gpu::open()?;
    let renderer = Renderer::new(&gpu, &sky::load(&SkySource::Nebula)?)?;
    let scene = Scene::new(camera, default_atlas(), Method::Lut)
        .map_err(viewer::chart::ChartError::Scene)?;
    let contenders = contenders(&scene).map_err(viewer::chart::ChartError::Scene)?;
    let folder = |error| CommandError::Folder(args.output.clone(), error);
    fs::create_dir_all(&args.output).map_err(folder)?;

    let progress = Progress::new("measuring", steps(effort, contenders.len()));
    let chart = measure(&gpu, &renderer, &scene, contenders, effort, || {
        progress.step();
    })?;
    progress.finish();
    let file = |name| args.output.join(name);
    write_whole(&file("gpu.csv"), csv::text(&chart).as_bytes()).map_err(folder)?;
    figure::write(&chart, &file("gpu.svg"), &file("gpu.png"))?;
    eprintln!("measured on {}", chart.adapter);
    for name in ["gpu.csv", "gpu.svg", "gpu.png"] {
        eprintln!("wrote {}", file(name).display());
    }
    Ok(Outcome::Done)
}
