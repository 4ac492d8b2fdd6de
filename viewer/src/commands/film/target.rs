//! Where the frames go: to files, or to a video.

use super::super::CommandError;
use super::files::FrameFiles;
use super::latent::Developed;
use super::plan::Plan;
use super::slate::Slate;
use super::video::{Video, VideoFormat};
use crate::cli::{FilmArgs, LayerName};
use lensbake_render::layers::Layer;
use lensbake_render::picture::PictureFormat;
use std::path::Path;
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
/// Memory of a pixel for each channel of a layer, bytes: a 32-bit float, and the same in the encoded file.
const CHANNEL_BYTES: usize = 8;

impl Target {
    /// The target at `path`, and the frames of `plan` that are not there yet. Everything about it is checked
    /// before a frame is drawn.
    pub(super) fn new(
        path: &Path,
        args: &FilmArgs,
        plan: &Plan,
    ) -> Result<(Self, Vec<u32>), CommandError> {
        match VideoFormat::of(path) {
            Some(format) => {
                let video = Video::new(path, format, plan.clock.rate(), args)?;
                Ok((Target::Video(video), plan.frames.clone()))
            }
            None => {
                let layers = LayerName::layers_of(&args.aov, &args.disc)?;
                let files = FrameFiles::new(path, frames_at_once(args.size(), &layers))?;
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
                let cores = available_parallelism().map_or(1, |cores| cores.get());
                cores.min(files.at_once)
            }
        }
    }

    /// Writes a frame.
    pub(super) fn write(&self, frame: &Developed, slate: &Slate) -> Result<(), CommandError> {
        match self {
            Target::Files(files) => files.write(frame, slate),
            Target::Video(video) => Ok(video.write(&frame.picture.srgb(frame.exposure))?),
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

/// Number of frames of this size, with these layers, that may be encoded at the same time: at least one.
fn frames_at_once((width, height): (u32, u32), layers: &[Layer]) -> usize {
    // A layer that is named twice is written once.
    let written = Layer::ALL.iter().filter(|layer| layers.contains(layer));
    let channels: usize = written.map(|layer| layer.components().len()).sum();
    let pixel_bytes = PIXEL_BYTES + CHANNEL_BYTES * channels;
    (MEMORY / (pixel_bytes * width as usize * height as usize)).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_take_memory_once_each() {
        let large = (3840, 2160);
        assert_eq!(frames_at_once(large, &[]), 4);
        assert_eq!(frames_at_once(large, &[Layer::Uv, Layer::Uv]), 2);
        assert_eq!(frames_at_once(large, &Layer::ALL), 1);
        assert_eq!(frames_at_once((16384, 16384), &Layer::ALL), 1);
    }
}
