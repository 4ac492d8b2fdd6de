//! Turns a panic in a third-party decoder into an error, without printing to standard error.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether this thread is inside a decoder.
    static DECODING: Cell<bool> = const { Cell::new(false) };
}

/// The result of `decode`, or `None` if it panics. `decode` must not start work on other threads: a panic there
/// would end the program.
pub fn caught<T>(decode: impl FnOnce() -> T) -> Option<T> {
    silence_decoders();
    let before = DECODING.replace(true);
    // State that a panic leaves inconsistent is dropped with the closure.
    let result = panic::catch_unwind(AssertUnwindSafe(decode));
    DECODING.set(before);
    result.ok()
}

/// Installs a panic hook that prints nothing for panics inside a decoder and passes on all others.
fn silence_decoders() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let other_panics = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !DECODING.get() {
                other_panics(info);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_nothing() {
        let words = [1, 2, 3];
        let beyond = words.len();
        assert_eq!(caught(|| words[std::hint::black_box(beyond)]), None);
        assert_eq!(caught(|| words[2]), Some(3));
        assert!(!DECODING.get());
    }
}
