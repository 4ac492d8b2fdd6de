//! `viewer flicker`: the light of stars in an orbit, frame by frame, against the analytic curve.

use super::{CommandError, gpu};
use crate::cli::FlickerArgs;
use lensbake_report::{Outcome, Printer, Progress, drawing, message};
use lensbake_tables::output::OutputFolder;
use viewer::camera::View;
use viewer::flicker::figure::Panels;
use viewer::flicker::{
    Orbit, Subject, Track, choose, closer_look, csv, follow, point_on_gpu, report,
};
use viewer::gpu::Gpu;
use viewer::scene::Scene;
use viewer::stars;

pub fn run(args: &FlickerArgs) -> Result<Outcome, CommandError> {
    let folder = OutputFolder::new(&args.output)?;
    let (table, picture) = (folder.file("flicker.csv")?, folder.file("flicker.png")?);
    let mut printer = Printer::new(false);
    let scenes = orbit(args).scenes()?;
    let subjects = subjects(&scenes, args.stars)?;
    let gpu = gpu(args.device)?;
    let mut tracks = follow_all(subjects, &scenes, &mut printer)?;
    let closer = closer_look(&tracks);
    if let Some(gpu) = &gpu {
        for &star in &closer {
            draw_again(gpu, &scenes, &mut tracks[star], &mut printer)?;
        }
    }
    let lines: String = tracks.iter().map(csv::line).collect();
    table.write((csv::HEAD.to_owned() + &lines).as_bytes())?;
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

fn orbit(args: &FlickerArgs) -> Orbit {
    let (width, height) = args.size;
    Orbit {
        view: View {
            radius: args.radius,
            width,
            height,
            ..View::default()
        },
        frames: args.frames,
    }
}

fn subjects(scenes: &[Scene], count: u32) -> Result<Vec<Subject>, CommandError> {
    let progress = Progress::new("choosing", count.into());
    let chosen = choose(&stars::hipparcos(), scenes, count as usize, |chosen| {
        progress.reach(chosen as u64);
    })?;
    progress.finish();
    Ok(chosen)
}

/// Follows the stars one by one, each printed when it is known.
fn follow_all(
    subjects: Vec<Subject>,
    scenes: &[Scene],
    printer: &mut Printer,
) -> Result<Vec<Track>, CommandError> {
    printer.print(&report::head());
    let mut tracks = Vec::with_capacity(subjects.len());
    for subject in subjects {
        let progress = Progress::new("following", scenes.len() as u64);
        let track = follow(subject, scenes, || progress.step())?;
        progress.finish();
        printer.print(&report::line(&track));
        tracks.push(track);
    }
    Ok(tracks)
}

fn draw_again(
    gpu: &Gpu,
    scenes: &[Scene],
    track: &mut Track,
    printer: &mut Printer,
) -> Result<(), CommandError> {
    let progress = Progress::new("on the GPU", track.frames.len() as u64);
    track.on_gpu = Some(point_on_gpu(gpu, scenes, track, || progress.step())?);
    progress.finish();
    printer.print(&report::gpu_line(track, &gpu.name()));
    Ok(())
}
