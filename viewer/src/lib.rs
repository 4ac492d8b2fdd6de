//! The window of the `viewer` program.

#[cfg(feature = "window")]
pub mod window;
