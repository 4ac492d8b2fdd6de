//! The window of the `viewer` program.

pub mod window;
