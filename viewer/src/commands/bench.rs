//! `viewer bench`: frames a second and time a ray, on the GPU at hand.

use super::CommandError;
use crate::cli::BenchArgs;
use lensbake_report::{Outcome, Printer, Progress, message};
use lensbake_tables::default_atlas;
use lensbake_tables::output::Output;
use std::path::PathBuf;
use std::time::Duration;
use viewer::bench::{self, Effort, SIZES, report};
use viewer::gpu::{Gpu, Renderer};
use viewer::sky::{self, SkySource};
use viewer::stars::{StarField, hipparcos};

/// Steps of the progress bar.
const STEPS: f64 = 1000.0;

pub fn run(args: &BenchArgs) -> Result<Outcome, CommandError> {
    let file = |path: &Option<PathBuf>| path.as_deref().map(Output::new).transpose();
    let (csv, json) = (file(&args.csv)?, file(&args.json)?);
    if let (Some(csv), Some(json)) = (&csv, &json) {
        csv.is_apart(json, ["--csv", "--json"])?;
    }
    if !(args.seconds >= 0.0 && args.seconds <= 3600.0) {
        return Err(CommandError::Seconds(args.seconds));
    }
    let effort = Effort {
        sizes: args.sizes.clone().unwrap_or(SIZES.to_vec()),
        swing: Duration::from_secs_f64(args.seconds.max(1e-3)),
        rounds: args.rounds,
    };
    let gpu = Gpu::open()?;
    let renderer = Renderer::new(&gpu, &sky::load(&SkySource::Nebula)?)?;
    let stars = StarField::new(&hipparcos(), 0.0);
    let progress = Progress::new("measuring", STEPS as u64);
    let bench = bench::run(renderer, &stars, default_atlas(), &effort, |part| {
        progress.reach((part * STEPS) as u64);
    })?;
    progress.finish();
    let data_on_stdout = [&csv, &json]
        .into_iter()
        .flatten()
        .any(Output::is_standard_output);
    let mut printer = Printer::new(data_on_stdout);
    printer.print(&report::text(&bench));
    let csv_written = csv.map_or(Ok(()), |file| write(&file, &report::csv(&bench)));
    if let Some(file) = json {
        write(&file, &report::json(&bench).map_err(CommandError::Json)?)?;
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
