//! User events that threads send to the event loop.

use lensbake_film::FlightPath;
use lensbake_render::sky::{Sky, SkyError, SkySource};
use lensbake_tables::Table;
use std::path::PathBuf;

/// The result of work on another thread.
#[derive(Debug)]
pub enum AppEvent {
    /// A sky, or why it cannot be loaded.
    Sky(SkySource, Result<Box<Sky>, SkyError>),
    /// A table that was dropped on the window.
    Table(PathBuf, Box<Table>),
    /// A path of the camera that was dropped on the window.
    Path(PathBuf, FlightPath),
    /// Why a dropped file cannot be used.
    Refused(String),
}
