//! `viewer reference`: the filtered picture against many rays a pixel by direct integration.

use super::{CommandError, print};
use crate::cli::ReferenceArgs;
use lensbake_report::{Outcome, Progress};
use lensbake_tables::container::write_whole;
use std::fs;
use viewer::gpu::{Gpu, Renderer};
use viewer::reference::{cases, cost, csv, figure, study};
use viewer::sky::{self, SkySource};

const SKIES: [(&str, SkySource); 3] = [
    ("nebula", SkySource::Nebula),
    ("starmap", SkySource::Starmap),
    ("grid", SkySource::Grid),
];

pub fn run(args: &ReferenceArgs) -> Result<Outcome, CommandError> {
    let folder = |error| CommandError::Folder(args.output.clone(), error);
    let (width, height) = args.size;
    let gpu = Gpu::open()?;
    if args.cost {
        return print_costs(&gpu);
    }
    fs::create_dir_all(&args.output).map_err(folder)?;
    print(csv::HEAD)?;
    let mut table = csv::HEAD.to_owned();
    let mut outcome = Outcome::Done;
    for (name, source) in SKIES {
        let renderer = Renderer::new(&gpu, &sky::load(&source)?)?;
        let mut studies = Vec::new();
        for case in cases(width, height) {
            let progress = Progress::new(name, height.into());
            let found = study(&renderer, case, args.rays, |rows| {
                progress.reach(rows.into())
            })?;
            progress.finish();
            let lines = csv::lines(name, &found);
            print(&lines)?;
            table += &lines;
            if !found.is_good() {
                eprintln!(
                    "viewer: the filtered {name} at {} misses its bar",
                    found.case.name
                );
                outcome = Outcome::Missed;
            }
            studies.push(found);
        }
        figure::write(&args.output.join(format!("{name}.png")), &studies)?;
    }
    write_whole(&args.output.join("filter.csv"), table.as_bytes()).map_err(folder)?;
    eprintln!(
        "measured on {}; wrote {}",
        gpu.name(),
        args.output.display()
    );
    Ok(outcome)
}

/// The cost at the radius of the default view, and at those of the seed report.
fn print_costs(gpu: &Gpu) -> Result<Outcome, CommandError> {
    let renderer = Renderer::new(gpu, &sky::load(&SkySource::Nebula)?)?;
    for radius in [25.0, 50.0, 10.0, 5.0, 2.0] {
        let cost = cost(&renderer, radius, (1920, 1080))?;
        print(&format!("{cost}\n"))?;
    }
    eprintln!("measured on {}", gpu.name());
    Ok(Outcome::Done)
}
