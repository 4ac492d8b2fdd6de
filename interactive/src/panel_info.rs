//! What the panel shows besides the settings.

use std::time::Duration;

/// What the panel shows besides the settings.
#[derive(Debug, Clone)]
pub struct PanelInfo {
    /// Names of the skies, and the index of the one shown.
    pub skies: (Vec<String>, usize),
    /// The mean time between frames while something moves.
    pub interval: Option<Duration>,
    /// Mean GPU time of the picture.
    pub picture_time: Option<Duration>,
    /// Mean GPU time of the whole frame, window and panel included.
    pub frame_time: Option<Duration>,
    /// Size of the picture, `[width, height]` in pixels.
    pub picture: [u32; 2],
    /// Name of the table in use.
    pub table: String,
    /// Largest error of the table on this side of the horizon, rad, if it was measured.
    pub table_error: Option<f64>,
    /// Upper bound on the rounding error of the GPU's 32-bit floats, pixels.
    pub rounding_px: f64,
    /// The path of the camera in a few words, and whether it plays.
    pub path: (String, bool),
    /// Why the radius is fixed, if it is.
    pub held_radius: Option<String>,
    /// Name of the GPU adapter.
    pub adapter: String,
}
