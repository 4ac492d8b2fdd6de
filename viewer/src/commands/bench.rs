//! `viewer bench`: frames a second and time a ray, on the GPU at hand.

use super::CommandError;
use crate::cli::BenchArgs;
use lensbake_report::{Outcome, Progress};
use lensbake_tables::container::{existing_folder, write_whole};
use lensbake_tables::default_atlas;
use std::io::Write;
use std::path::Path;
use std::time::Duration;
use viewer::bench::{self, Effort, SIZES, report};
use viewer::gpu::{Gpu, Renderer};
use viewer::sky::{self, SkySource};
use viewer::stars::{StarField, hipparcos};

/// Steps of the progress bar.
const STEPS: f64 = 1000.0;

pub fn run(args: &BenchArgs) -> Result<Outcome, CommandError> {
    let files = [&args.csv, &args.json];
    for file in files.into_iter().flatten() {
        existing_folder(file).map_err(|error| CommandError::File(file.clone(), error))?;
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
    std::io::stdout()
        .write_all(report::text(&bench).as_bytes())
        .map_err(CommandError::Stdout)?;
    let write = |file: &Path, text: String| {
        write_whole(file, text.as_bytes())
            .map_err(|error| CommandError::File(file.to_owned(), error))?;
        eprintln!("wrote {}", file.display());
        Ok::<_, CommandError>(())
    };
    if let Some(file) = &args.csv {
        write(file, report::csv(&bench))?;
    }
    if let Some(file) = &args.json {
        write(file, report::json(&bench).map_err(CommandError::Json)?)?;
    }
    Ok(Outcome::Done)
}
