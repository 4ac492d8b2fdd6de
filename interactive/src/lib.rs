//! What an interactive viewer of the lensed sky is made of, in a window or in a web page. Nothing here knows a window
//! system, a page or a clock: the caller passes events, and times since a start of its choice.
//!
//! [`input`] turns keys, pointer, wheel and touches into changes of the [`settings`]. The [`state`] keeps the changes that
//! can be drawn, a frame makes a [`plan`] of it, and the [`stage`] draws the plan to a surface. A [`session`] holds them.
//! Movement by keys and pointer ([`motion`]), by itself (`travel`: the fall and the orbit by proper time) and along a path
//! ([`recording`]) depends on elapsed time, not on the frame rate.

pub mod disc_choice;
pub mod fall;
pub mod frame_clock;
mod held_keys;
pub mod input;
pub mod keys;
pub mod meter;
pub mod motion;
pub mod motion_choice;
pub mod motion_facts;
pub mod panel_info;
pub mod parameters;
pub mod plan;
pub mod recording;
mod render_pass;
pub mod resolution;
pub mod screenshot;
pub mod session;
pub mod settings;
pub mod skies;
pub mod stage;
pub mod star_notice;
pub mod state;
pub mod title;
mod travel;
