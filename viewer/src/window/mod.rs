//! The window, which draws the lensed sky in real time.
//!
//! The event loop passes events to the settings of [`lensbake_interactive`], which also draws the frames. What is here
//! is about windows: the events, the panel, the threads that load files, and when the next frame is due. Nothing is
//! drawn while nothing changes.

mod app;
mod coming;
mod controls;
mod disc_controls;
mod error;
mod event;
mod files;
mod input;
mod message;
mod motion_controls;
mod open_window;
mod pace;
mod panel;
mod path;
mod saved;
#[cfg(test)]
mod state_motion_tests;
#[cfg(test)]
mod state_tests;
mod typed;

pub use app::{Options, run};
pub use coming::Coming;
pub use error::WindowError;
