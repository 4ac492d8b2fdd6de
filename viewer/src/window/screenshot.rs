//! The file of a screenshot.

use lensbake_program::output::{self, OutputError};
use lensbake_render::picture::{PictureError, encode_png};
use std::path::PathBuf;
use thiserror::Error;

/// Why a screenshot cannot be written.
#[derive(Debug, Error)]
pub(super) enum ScreenshotError {
    /// The picture cannot be encoded.
    #[error(transparent)]
    Encode(#[from] PictureError),
    /// The file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// Writes a screenshot to the first free `lensbake-N.png` of the current folder, and returns its name.
pub(super) fn write([width, height]: [u32; 2], pixels: &[u8]) -> Result<PathBuf, ScreenshotError> {
    let free = (1..)
        .map(|n| PathBuf::from(format!("lensbake-{n}.png")))
        .find(|path| !path.exists())
        .expect("numbers do not end");
    output::write(&free, &encode_png(width, height, pixels)?)?;
    Ok(free)
}
