//! Where the frames go: to files, or to a video.

use super::super::CommandError;
use super::files::FrameFiles;
use super::plan::Plan;
use super::video::{Video, VideoFormat};
use crate::cli::FilmArgs;
use lensbake_render::picture::{Picture, PictureFormat};
use std::thread::available_parallelism;

/// Where the frames go.
pub(super) enum Target {
    Files(FrameFiles),
    Video(Video),
}

/// Memory for the frames that are encoded at the same time, bytes.
const MEMORY: usize = 1 << 30;
/// Memory of a pixel while its frame is encoded, bytes: light, 8-bit colours, and the encoded file.
const PIXEL_BYTES: usize = 32;

impl Target {
    /// The target that the arguments name, and the frames of `plan` that are not there yet. Everything about it is checked
    /// before a frame is drawn.
    pub(super) fn new(args: &FilmArgs, plan: &Plan) -> Result<(Self, Vec<u32>), CommandError> {
        // It is missing only with --save-path, which draws nothing.
        let path = args.output.as_deref().unwrap_or("".as_ref());
        match VideoFormat::of(path) {
            Some(format) => {
                let video = Video::new(path, format, plan.clock.rate(), args)?;
                Ok((Target::Video(video), plan.frames.clone()))
            }
            None => {
                let files = FrameFiles::new(path, args.size)?;
                let frames = files.missing(&plan.frames, args)?;
                Ok((Target::Files(files), frames))
            }
        }
    }

    /// Its name in messages.
    pub(super) fn name(&self) -> String {
        match self {
            Target::Files(files) => files.name(),
            Target::Video(video) => video.name(),
        }
    }

    /// Whether frames keep all their light, whatever the exposure.
    pub(super) fn keeps_light(&self) -> bool {
        matches!(self, Target::Files(files) if files.format == PictureFormat::OpenExr)
    }

    /// Number of threads that may call [`Target::write`]: one where frames must come in order.
    pub(super) fn threads(&self) -> usize {
        match self {
            Target::Video(_) => 1,
            Target::Files(files) => {
                let (width, height) = files.size;
                let fit = MEMORY / (PIXEL_BYTES * width as usize * height as usize);
                let cores = available_parallelism().map_or(1, |cores| cores.get());
                cores.min(fit).max(1)
            }
        }
    }

    /// Writes a frame at an exposure in stops.
    pub(super) fn write(
        &self,
        frame: u32,
        picture: &Picture,
        exposure: f32,
    ) -> Result<(), CommandError> {
        match self {
            Target::Files(files) => files.write(frame, picture, exposure),
            Target::Video(video) => Ok(video.write(&picture.srgb(exposure))?),
        }
    }

    /// Closes the video, if it is one.
    pub(super) fn finish(&self) -> Result<(), CommandError> {
        match self {
            Target::Files(_) => Ok(()),
            Target::Video(video) => video.finish(),
        }
    }
}
