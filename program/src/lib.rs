//! The parts shared by the programs `bake` and `viewer`: arguments, messages, printed results, progress bars,
//! output files and exit codes.

pub mod arguments;
mod message;
mod outcome;
pub mod output;
mod printer;
mod progress;

pub use message::message;
pub use outcome::Outcome;
pub use printer::{PrintError, Printer};
pub use progress::Progress;
