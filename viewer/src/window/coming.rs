//! What the first frame needs and another thread makes while the window and the GPU are opened.

use std::panic;
use std::thread::{self, JoinHandle};

/// A value that is there, or that a thread is making.
#[derive(Debug)]
pub enum Coming<T> {
    /// It is there.
    Here(T),
    /// A thread is making it.
    Soon(JoinHandle<T>),
}

impl<T: Send + 'static> Coming<T> {
    /// The value that `make` makes, in a thread of its own.
    pub fn soon(make: impl FnOnce() -> T + Send + 'static) -> Self {
        Coming::Soon(thread::spawn(make))
    }

    /// The value, as soon as it is there.
    pub fn wait(self) -> T {
        match self {
            Coming::Here(value) => value,
            Coming::Soon(thread) => thread.join().unwrap_or_else(|e| panic::resume_unwind(e)),
        }
    }
}
