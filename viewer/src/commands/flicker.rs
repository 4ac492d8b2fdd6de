//! `viewer flicker`: compares the light of stars during a flight, frame by frame, with the analytic light curve.

use super::{CommandError, gpu};
use crate::cli::FlickerArgs;
use lensbake_program::output::OutputFolder;
use lensbake_program::{Outcome, Printer, Progress, message};
use lensbake_render::camera::View;
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::Lens;
use lensbake_render::stars;
use lensbake_studies::figure::drawing;
use lensbake_studies::flicker::figure::Panels;
use lensbake_studies::flicker::{
    Flight, Subject, Track, choose, closer_look, follow, point_on_gpu, report,
};
use pollster::block_on;

pub fn run(args: &FlickerArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let (table, picture) = (folder.file("flicker.csv")?, folder.file("flicker.png")?);
    let mut printer = Printer::new(false);
    let lenses = flight(args).lenses()?;
    let subjects = subjects(&lenses, args.stars)?;
    let gpu = gpu(args.device)?;
    let mut tracks = follow_all(subjects, &lenses, &mut printer)?;
    let closer = closer_look(&tracks);
    if let Some(gpu) = &gpu {
        let renderer = Renderer::new(gpu);
        for &star in &closer {
            draw_again(&renderer, &lenses, &mut tracks[star], &mut printer)?;
        }
    }
    let lines: String = tracks.iter().map(report::csv_line).collect();
    table.write((report::CSV_HEAD.to_owned() + &lines).as_bytes())?;
    let shown: Vec<&Track> = closer.iter().map(|&star| &tracks[star]).collect();
    picture.write(&drawing::png(&Panels(&shown))?)?;
    message!("wrote {}", folder.path().display());
    printer.finish()?;
    let missed = tracks.iter().filter(|track| !track.is_good()).count();
    if missed > 0 {
        message!("viewer: {missed} of {} stars flicker", tracks.len());
        return Ok(Outcome::Missed);
    }
    Ok(Outcome::Done)
}

fn flight(args: &FlickerArgs) -> Flight {
    let (width, height) = args.size;
    Flight {
        view: View {
            radius: args.radius,
            motion: args.motion,
            yaw_deg: args.yaw,
            width,
            height,
            ..View::default()
        },
        frames: args.frames,
    }
}

fn subjects(lenses: &[Lens], count: u32) -> Result<Vec<Subject>, CommandError> {
    let progress = Progress::new("choosing", count.into());
    let chosen = choose(&stars::hipparcos(), lenses, count as usize, |chosen| {
        progress.reach(chosen as u64);
    })?;
    progress.finish();
    Ok(chosen)
}

/// Follows the stars one by one and prints each result as soon as it is known.
fn follow_all(
    subjects: Vec<Subject>,
    lenses: &[Lens],
    printer: &mut Printer,
) -> Result<Vec<Track>, CommandError> {
    printer.print(&report::head());
    let mut tracks = Vec::with_capacity(subjects.len());
    for subject in subjects {
        let progress = Progress::new("following", lenses.len() as u64);
        let track = follow(subject, lenses, || progress.step());
        progress.finish();
        printer.print(&report::line(&track));
        tracks.push(track);
    }
    Ok(tracks)
}

fn draw_again(
    renderer: &Renderer,
    lenses: &[Lens],
    track: &mut Track,
    printer: &mut Printer,
) -> Result<(), CommandError> {
    let progress = Progress::new("on the GPU", track.frames.len() as u64);
    let off = point_on_gpu(renderer, lenses, track, || progress.step());
    track.on_gpu = Some(block_on(off)?);
    progress.finish();
    printer.print(&report::gpu_line(track, &renderer.gpu().name()));
    Ok(())
}
