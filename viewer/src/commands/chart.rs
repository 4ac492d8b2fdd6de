//! `viewer chart`: charts speed against accuracy of every method of drawing, on this machine's GPU.

use super::CommandError;
use crate::cli::ChartArgs;
use lensbake_program::output::OutputFolder;
use lensbake_program::{Outcome, Progress, message};
use lensbake_render::camera::{Camera, View};
use lensbake_render::gpu::{Gpu, Renderer};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::sky::{self, SkySource};
use lensbake_studies::figure::drawing;
use lensbake_studies::gpu_chart::figure::ChartFigure;
use lensbake_studies::gpu_chart::{
    ChartError, Workload, contenders, csv, drawings, falling, formats, measure, steps,
};
use lensbake_tables::default_atlas;
use pollster::block_on;
use std::sync::Arc;

pub fn run(args: &ChartArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let [table, svg, png] = ["gpu.csv", "gpu.svg", "gpu.png"].map(|name| folder.file(name));
    let (table, svg, png) = (table?, svg?, png?);
    let (workload, default_size) = if args.quick {
        (Workload::QUICK, (320, 180))
    } else {
        (Workload::FULL, (1920, 1080))
    };
    let (width, height) = args.size.unwrap_or(default_size);
    let view = View {
        radius: args.radius,
        fov_deg: args.fov,
        width,
        height,
        ..View::default()
    };
    let camera = Camera::new(&view)?;
    let renderer = Renderer::new(&block_on(Gpu::open())?);
    let sky = Arc::new(sky::load(&SkySource::Nebula)?);
    let lens = Lens::new(camera, default_atlas(), Deflection::Lut).map_err(ChartError::Lens)?;
    let mut contenders = contenders(&lens).map_err(ChartError::Lens)?;
    let unorm16 = renderer.gpu().has_unorm16();
    if !unorm16 {
        message!("the device has no textures of 16-bit integers: that row is left out");
    }
    contenders.extend(formats(&lens, unorm16));
    contenders.extend(drawings(&lens));
    contenders.extend(falling(&view, default_atlas())?);
    let progress = Progress::new("measuring", steps(workload, contenders.len()));
    let step = || progress.step();
    let measured = measure(&renderer, &lens, &sky, contenders, workload, step);
    let chart = block_on(measured)?;
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
