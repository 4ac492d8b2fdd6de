//! `viewer bench`: measures frames per second and time per ray on this machine's GPU.

use super::{CommandError, renderer};
use crate::cli::BenchArgs;
use lensbake_program::output::Output;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_render::gpu::Gpu;
use lensbake_render::sky::{self, SkySource};
use lensbake_render::stars::{StarField, hipparcos};
use lensbake_studies::bench::figure::CostOfSize;
use lensbake_studies::bench::{self, SIZES, Workload, report};
use lensbake_studies::figure::drawing::svg;
use lensbake_tables::default_atlas;
use pollster::block_on;
use std::path::PathBuf;
use std::time::Duration;

/// Steps of the progress bar.
const STEPS: f64 = 1000.0;

pub fn run(args: &BenchArgs) -> Result<Outcome, CommandError> {
    let file = |path: &Option<PathBuf>| path.as_deref().map(Output::new).transpose();
    let (csv, json, plot) = (file(&args.csv)?, file(&args.json)?, file(&args.plot)?);
    let names = ["--csv", "--json", "--plot"];
    let files = [&csv, &json, &plot];
    for (one, other) in [(0, 1), (0, 2), (1, 2)] {
        if let (Some(first), Some(second)) = (files[one], files[other]) {
            first.is_apart(second, [names[one], names[other]])?;
        }
    }
    if !(args.seconds >= 0.0 && args.seconds <= 3600.0) {
        return Err(CommandError::Seconds(args.seconds));
    }
    let workload = Workload {
        sizes: args.sizes.clone().unwrap_or(SIZES.to_vec()),
        swing: Duration::from_secs_f64(args.seconds.max(1e-3)),
        rounds: args.rounds,
        radius: args.radius,
    };
    let renderer = renderer(&block_on(Gpu::open())?, args.pass)?;
    let sky = sky::load(&SkySource::Nebula)?;
    let stars = StarField::new(&hipparcos(), 0.0);
    let progress = Progress::new("measuring", STEPS as u64);
    let reach = |part| progress.reach((part * STEPS) as u64);
    let run = bench::run(&renderer, &sky, &stars, default_atlas(), &workload, reach);
    let bench = block_on(run)?;
    progress.finish();
    let data_on_stdout = [&csv, &json, &plot]
        .into_iter()
        .flatten()
        .any(Output::is_standard_output);
    let mut printer = Printer::new(data_on_stdout);
    printer.print(&report::text(&bench));
    let csv_written = csv.map_or(Ok(()), |file| write(&file, &report::csv(&bench)));
    if let Some(file) = json {
        write(&file, &report::json(&bench).map_err(CommandError::Json)?)?;
    }
    if let Some(file) = plot {
        write(&file, &svg(&CostOfSize(&bench))?)?;
    }
    csv_written?;
    printer.finish()?;
    Ok(Outcome::Done)
}

fn write(file: &Output, text: &str) -> Result<(), CommandError> {
    file.write(text.as_bytes())?;
    message!("wrote {}", file.name());
    Ok(())
}
