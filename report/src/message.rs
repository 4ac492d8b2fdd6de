//! Messages to the person: on standard error, where nobody need be.

use std::fmt::Display;
use std::io::Write;

/// Writes one line to standard error. A message that can't be written, since the stream is closed or full,
/// is dropped: it must never cost the work that it is about.
pub fn message(text: impl Display) {
    let line = format!("{text}\n");
    let _ = std::io::stderr().write_all(line.as_bytes());
}

/// [`message`](crate::message()) of a formatted text.
#[macro_export]
macro_rules! message {
    ($($text:tt)*) => { $crate::message(format_args!($($text)*)) };
}
