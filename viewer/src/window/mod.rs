//! The window, which draws the lensed sky in real time.
//!
//! The event loop passes key bindings ([`keys`]), mouse and panel to the [`settings`]. The [`state`] keeps the
//! changes that can be drawn, a frame makes a [`plan`] of it, and the `stage` draws the plan to the surface.
//! Movement by keys and mouse ([`motion`]) and by itself (`travel`: the fall and the orbit by proper time) depends on
//! elapsed time, not on the frame rate. Nothing is drawn while nothing changes.

mod app;
mod controls;
mod error;
mod event;
mod fall;
mod files;
mod great_circle;
mod held_keys;
mod input;
pub mod keys;
mod message;
mod meter;
pub mod motion;
mod motion_choice;
mod motion_controls;
mod motion_facts;
mod open_window;
mod pace;
mod panel;
mod panel_info;
pub mod plan;
mod render_pass;
mod resolution;
mod screenshot;
pub mod settings;
mod skies;
mod stage;
mod star_notice;
pub mod state;
#[cfg(test)]
mod state_motion_tests;
#[cfg(test)]
mod state_tests;
mod title;
mod travel;
mod typed;

pub use app::{Options, run};
pub use error::WindowError;
pub use resolution::{AutoScale, Resolution};
