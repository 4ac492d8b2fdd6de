//! Draws the frames and, at the same time in other threads, adds the stars, encodes and writes them.

use super::super::CommandError;
use super::latent::Latent;
use super::slate::Slate;
use super::target::Target;
use lensbake_program::Progress;
use lensbake_render::picture::WithoutValue;
use lensbake_render::stars::SortedStars;
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Frames that may wait to be encoded. An interruption loses these, the one that is drawn and those that are encoded.
const WAITING: usize = 1;

/// What was drawn, and where the time went.
pub(super) struct Summary {
    pub(super) frames: u32,
    pub(super) wall: Duration,
    /// Time in which a frame was drawn and read back.
    pub(super) drawing: Duration,
    /// Time in which frames were encoded, the sum over the threads.
    pub(super) encoding: Duration,
    /// Number of threads that encode.
    pub(super) threads: usize,
    /// The first frame with pixels whose light could not be computed.
    pub(super) first_lost: Option<(u32, WithoutValue)>,
}

/// What the encoding threads have done so far.
#[derive(Default)]
struct Done {
    frames: u32,
    encoding: Duration,
    first_lost: Option<(u32, WithoutValue)>,
    failure: Option<CommandError>,
}

/// Draws `frames` in order to `target`. After a failure, the frames that were drawn before it are still written.
pub(super) fn expose(
    frames: &[u32],
    stars: Option<&SortedStars>,
    target: &Target,
    slate: &Slate,
) -> Result<Summary, CommandError> {
    let (progress, started) = (
        Progress::new("filming", frames.len() as u64),
        Instant::now(),
    );
    let done = Mutex::new(Done::default());
    let threads = target.threads();
    let drawing = thread::scope(|scope| {
        let (sender, receiver) = sync_channel(WAITING);
        let receiver = std::sync::Arc::new(Mutex::new(receiver));
        for _ in 0..threads {
            let receiver = receiver.clone();
            let (done, progress) = (&done, &progress);
            scope.spawn(move || develop_all(&receiver, stars, target, slate, done, progress));
        }
        // Without receivers, which end at the first failure, sending fails instead of waiting.
        drop(receiver);
        let mut drawing = Duration::ZERO;
        for &frame in frames {
            let begun = Instant::now();
            let latent = slate.camera.expose(frame)?;
            drawing += begun.elapsed();
            if lock(&done).failure.is_some() || sender.send(latent).is_err() {
                break;
            }
        }
        Ok::<_, CommandError>(drawing)
    });
    progress.finish();
    let done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    match done.failure {
        Some(failure) => Err(failure),
        None => Ok(Summary {
            frames: done.frames,
            wall: started.elapsed(),
            drawing: drawing?,
            encoding: done.encoding,
            threads,
            first_lost: done.first_lost,
        }),
    }
}

/// Encodes and writes frames until there are no more, or one fails.
fn develop_all(
    receiver: &Mutex<Receiver<Latent>>,
    stars: Option<&SortedStars>,
    target: &Target,
    slate: &Slate,
    done: &Mutex<Done>,
    progress: &Progress,
) {
    loop {
        let received = lock(receiver).recv();
        let Ok(latent) = received else { return };
        let begun = Instant::now();
        let Some(developed) = latent.developed(stars, slate.camera).transpose() else {
            continue;
        };
        let written = developed.and_then(|frame| target.write(&frame, slate).map(|()| frame));
        let mut done = lock(done);
        let frame = match written {
            Ok(frame) => frame,
            Err(failure) => {
                done.failure.get_or_insert(failure);
                return;
            }
        };
        done.frames += 1;
        done.encoding += begun.elapsed();
        if let Some(lost) = frame.picture.without_value() {
            let first = done.first_lost.filter(|&(first, _)| first < frame.frame);
            done.first_lost = first.or(Some((frame.frame, lost)));
        }
        progress.step();
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
