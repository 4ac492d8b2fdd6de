//! Messages to the user, on standard error, which may be closed.

use std::fmt::Display;
use std::io::Write;

/// Writes one line to standard error. If the stream is closed or full, the message is dropped: it must never make
/// the work itself fail.
pub fn message(text: impl Display) {
    let line = format!("{text}\n");
    let _ = std::io::stderr().write_all(line.as_bytes());
}

/// [`message`](crate::message()) of a formatted text.
#[macro_export]
macro_rules! message {
    ($($text:tt)*) => { $crate::message(format_args!($($text)*)) };
}
