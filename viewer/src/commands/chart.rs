//! `viewer chart`: speed against accuracy of every way to draw, on the GPU at hand.

use super::CommandError;
use crate::cli::ChartArgs;
use lensbake_report::{Outcome, Progress, drawing, message};
use lensbake_tables::default_atlas;
use lensbake_tables::output::OutputFolder;
use viewer::camera::{Camera, View};
use viewer::chart::figure::ChartFigure;
use viewer::chart::{Effort, contenders, csv, measure, steps};
use viewer::gpu::{Gpu, Renderer};
use viewer::scene::{Method, Scene};
use viewer::sky::{self, SkySource};

pub fn run(args: &ChartArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let [table, svg, png] = ["gpu.csv", "gpu.svg", "gpu.png"].map(|name| folder.file(name));
    let (table, svg, png) = (table?, svg?, png?);
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
    let progress = Progress::new("measuring", steps(effort, contenders.len()));
    let chart = measure(&gpu, &renderer, &scene, contenders, effort, || {
        progress.step();
    })?;
    progress.finish();
    table.write(csv::text(&chart).as_bytes())?;
    let figure = ChartFigure(&chart);
    svg.write(drawing::svg(&figure)?.as_bytes())?;
    png.write(&drawing::png(&figure)?)?;
    message!("measured on {}", chart.adapter);
    for file in [table, svg, png] {
        message!("wrote {}", file.name());
    }
    Ok(Outcome::Done)
}
