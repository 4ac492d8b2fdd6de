//! What `bake` and `viewer` have in common as programs: how they read their arguments and end, and how
//! they show what they measured.

pub mod arguments;
pub mod csv;
pub mod drawing;
mod font;
mod message;
mod outcome;
mod pareto;
mod printer;
mod progress;
mod time;

pub use message::message;
pub use outcome::Outcome;
pub use pareto::front;
pub use printer::{PrintError, Printer};
pub use progress::Progress;
pub use time::{Time, median};
