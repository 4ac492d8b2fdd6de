//! A file for each frame.

use super::super::CommandError;
use super::latent::Developed;
use super::slate::Slate;
use super::{FilmError, spare_inputs};
use crate::cli::FilmArgs;
use lensbake_film::FrameNames;
use lensbake_program::output::Output;
use lensbake_render::picture::PictureFormat;
use std::path::Path;

/// The files of the frames.
pub(super) struct FrameFiles {
    pub(super) format: PictureFormat,
    /// Number of frames that may be encoded at the same time.
    pub(super) at_once: usize,
    names: FrameNames,
    pattern: String,
}

impl FrameFiles {
    /// Files named by the pattern `path`, of frames of which `at_once` may be encoded at the same time.
    pub(super) fn new(path: &Path, at_once: usize) -> Result<Self, CommandError> {
        let names = FrameNames::new(path).map_err(FilmError::from)?;
        Ok(FrameFiles {
            format: PictureFormat::of(path, PictureFormat::ALL)?,
            at_once,
            names,
            pattern: path.display().to_string(),
        })
    }

    pub(super) fn name(&self) -> String {
        self.pattern.clone()
    }

    /// Those of `frames` that are to be drawn: all with `--overwrite`, otherwise those without a file. Checks that files can
    /// be created, and that no input is overwritten.
    pub(super) fn missing(
        &self,
        frames: &[u32],
        args: &FilmArgs,
    ) -> Result<Vec<u32>, CommandError> {
        if let Some(&first) = frames.first() {
            Output::binary(&self.names.path(first))?;
        }
        let (existing, mut missing): (Vec<u32>, Vec<u32>) = frames
            .iter()
            .partition(|&&frame| self.names.path(frame).exists());
        if args.overwrite {
            for frame in existing {
                let output = Output::binary(&self.names.path(frame))?;
                spare_inputs(&output, args)?;
            }
            missing = frames.to_vec();
        }
        Ok(missing)
    }

    pub(super) fn write(&self, frame: &Developed, slate: &Slate) -> Result<(), CommandError> {
        let bytes = match self.format {
            PictureFormat::OpenExr => slate.openexr(frame)?,
            PictureFormat::Png => frame.picture.encode(self.format, frame.exposure)?,
        };
        Ok(Output::binary(&self.names.path(frame.frame))?.write(&bytes)?)
    }
}
