//! The files that the window writes to the current folder.

use lensbake_film::FlightPath;
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

/// Writes a screenshot to the first free `lensbake-N.png`, and returns its name.
pub(super) fn screenshot(
    [width, height]: [u32; 2],
    pixels: &[u8],
) -> Result<PathBuf, ScreenshotError> {
    let free = free("lensbake", "png");
    output::write(&free, &encode_png(width, height, pixels)?)?;
    Ok(free)
}

/// Writes a path of the camera to the first free `lensbake-path-N.json`, and returns its name.
pub(super) fn path(path: &FlightPath) -> Result<PathBuf, OutputError> {
    let free = free("lensbake-path", "json");
    output::write(&free, path.to_json().as_bytes())?;
    Ok(free)
}

/// The first free `NAME-N.ENDING` of the current folder.
fn free(name: &str, ending: &str) -> PathBuf {
    (1..)
        .map(|n| PathBuf::from(format!("{name}-{n}.{ending}")))
        .find(|path| !path.exists())
        .expect("numbers do not end")
}
