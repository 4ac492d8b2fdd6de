//! The window: the lensed sky, live, from the table.
//!
//! Keys ([`keys`]), mouse and panel change the [`settings`]; a frame makes a [`plan`] of them, and the
//! `stage` draws it. What moves does so by elapsed time ([`motion`]). Between two frames of the same
//! plan nothing is drawn.

mod app;
mod files;
mod input;
pub mod keys;
mod meter;
pub mod motion;
mod panel;
pub mod plan;
mod resolution;
mod running;
mod screenshot;
pub mod settings;
mod skies;
mod stage;
mod star_notice;

pub use app::{Options, run};
pub use resolution::{AutoScale, Resolution};

use crate::gpu::GpuError;
use crate::sky::SkyError;
use lensbake_tables::{Row, Table};
use settings::Settings;
use thiserror::Error;

/// A window that cannot be opened, or had to close.
#[derive(Debug, Error)]
pub enum WindowError {
    /// There is no screen.
    #[error("no window can be opened here ({0}); `viewer render` draws without one")]
    NoScreen(String),
    /// The window system failed.
    #[error("the window failed: {0}")]
    WindowSystem(String),
    /// The GPU.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The sky that was asked for.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The table does not serve the camera.
    #[error("{name}: {problem}")]
    Plan {
        /// The table.
        name: String,
        /// What is wrong.
        problem: plan::PlanError,
    },
}

impl WindowError {
    /// Of what the window system says, without the place in its source that it adds.
    fn no_screen(error: &impl ToString) -> Self {
        let text = error.to_string();
        let reason = text.rsplit(": ").next().unwrap_or(&text);
        WindowError::NoScreen(reason.trim_end_matches('.').to_owned())
    }
}

/// The row with which a table serves the camera at the start: of the shape of all its rows.
fn row(settings: &Settings, table: &Table, name: &str) -> Result<Row, WindowError> {
    match plan::Plan::new(settings, table, [1, 1], 1.0) {
        Ok(plan) => Ok(plan.scene.row),
        Err(problem) => Err(WindowError::Plan {
            name: name.to_owned(),
            problem,
        }),
    }
}
