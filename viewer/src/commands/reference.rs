//! `viewer reference`: compares the filtered picture with many rays per pixel by direct integration.

use super::CommandError;
use crate::cli::ReferenceArgs;
use lensbake_program::output::OutputFolder;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_render::disc::Disc;
use lensbake_render::gpu::{Gpu, Renderer};
use lensbake_render::sky::{self, SkySource};
use lensbake_studies::reference::{
    DiscStudy, cases, cost, csv, disc_cases, disc_study, figure, study,
};
use pollster::block_on;
use std::sync::Arc;

const SKIES: [(&str, SkySource); 3] = [
    ("nebula", SkySource::Nebula),
    ("starmap", SkySource::Starmap),
    ("grid", SkySource::Grid),
];

pub fn run(args: &ReferenceArgs) -> Result<Outcome, CommandError> {
    if args.disc {
        return compare_discs(args);
    }
    let (width, height) = args.size;
    let gpu = block_on(Gpu::open())?;
    if args.cost {
        return print_costs(&gpu);
    }
    let folder = OutputFolder::new(&args.output)?;
    let file = folder.file("filter.csv")?;
    let mut printer = Printer::new(false);
    printer.print(csv::HEAD);
    let mut table = csv::HEAD.to_owned();
    let renderer = Renderer::new(&gpu);
    let mut outcome = Outcome::Done;
    for (name, source) in SKIES {
        let picture = folder.file(&format!("{name}.png"))?;
        let sky = Arc::new(sky::load(&source)?);
        let mut studies = Vec::new();
        for case in cases(width, height) {
            let progress = Progress::new(name, height.into());
            let reach = |rows: u32| progress.reach(rows.into());
            let found = block_on(study(&renderer, &sky, case, args.rays, reach))?;
            progress.finish();
            let lines = csv::lines(name, &found);
            printer.print(&lines);
            table += &lines;
            if !found.is_good() {
                message!(
                    "viewer: the filtered {name} at {} misses its bar",
                    found.case.name
                );
                outcome = Outcome::Missed;
            }
            studies.push(found);
        }
        picture.write(&figure::png(&studies)?)?;
    }
    file.write(table.as_bytes())?;
    message!(
        "measured on {}; wrote {}",
        gpu.name(),
        folder.path().display()
    );
    printer.finish()?;
    Ok(outcome)
}

/// Compares pictures of a disc before the nebula with their references.
fn compare_discs(args: &ReferenceArgs) -> Result<Outcome, CommandError> {
    let (width, height) = args.size;
    let name = args.only.as_deref().unwrap_or_default();
    let mut cases = disc_cases(&Disc::default(), width, height);
    cases.retain(|case| case.name.contains(name));
    if cases.is_empty() {
        return Err(CommandError::NoSuchView(name.to_owned()));
    }
    let gpu = super::gpu(args.device)?;
    let renderer = gpu.as_ref().map(Renderer::new);
    let folder = OutputFolder::new(&args.output)?;
    let (file, figure_file) = (folder.file("disc.csv")?, folder.file("disc.png")?);
    let sky = Arc::new(sky::load(&SkySource::Nebula)?);
    let mut printer = Printer::new(false);
    let mut table = csv::DISC_HEAD.to_owned();
    printer.print(&table);
    let mut studies = Vec::new();
    for case in cases {
        let progress = Progress::new("disc", height.into());
        let row_done = || progress.step();
        let study = disc_study(renderer.as_ref(), &sky, case, args.rays, row_done);
        let found = block_on(study)?;
        progress.finish();
        let lines = csv::disc_lines("nebula", &found);
        printer.print(&lines);
        table += &lines;
        studies.push(found);
    }
    figure_file.write(&figure::png(&studies)?)?;
    file.write(table.as_bytes())?;
    message!("wrote {}", folder.path().display());
    printer.finish()?;
    Ok(disc_outcome(&studies))
}

/// Names the views whose filtered picture of a disc misses its bar.
fn disc_outcome(studies: &[DiscStudy]) -> Outcome {
    let missed = studies.iter().filter(|study| !study.is_good());
    let missed: Vec<&str> = missed.map(|study| study.case.name.as_str()).collect();
    if missed.is_empty() {
        return Outcome::Done;
    }
    let names = missed.join("; ");
    message!("viewer: the filtered disc misses its bar: {names}");
    Outcome::Missed
}

/// Prints the cost of filtering at the radius of the default view, and at those of bholetrace's report.
fn print_costs(gpu: &Gpu) -> Result<Outcome, CommandError> {
    let renderer = Renderer::new(gpu);
    let sky = Arc::new(sky::load(&SkySource::Nebula)?);
    let mut printer = Printer::new(false);
    for radius in [25.0, 50.0, 10.0, 5.0, 2.0] {
        let cost = block_on(cost(&renderer, &sky, radius, (1920, 1080)))?;
        printer.print(&format!("{cost}\n"));
    }
    printer.finish()?;
    message!("measured on {}", gpu.name());
    Ok(Outcome::Done)
}
