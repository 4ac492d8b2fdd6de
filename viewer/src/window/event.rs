//! User events that threads send to the event loop.

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
    /// Why a dropped file cannot be used.
    Refused(String),
}
