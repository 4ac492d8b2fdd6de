//! A progress bar for long work: on a terminal only, and only once a second has passed.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Once;
use std::time::{Duration, Instant};

/// A progress bar that appears after a second.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    shown: Once,
}

impl Progress {
    /// A bar of `length` steps.
    pub fn new(what: &'static str, length: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent} % {eta}") {
            bar.set_style(style);
        }
        bar.set_message(what);
        Progress {
            bar,
            started: Instant::now(),
            shown: Once::new(),
        }
    }

    /// Advances by one step.
    pub fn step(&self) {
        self.bar.inc(1);
        self.show_if_long();
    }

    /// Sets the number of finished steps.
    pub fn reach(&self, steps: u64) {
        self.bar.set_position(steps);
        self.show_if_long();
    }

    fn show_if_long(&self) {
        if self.started.elapsed() > Duration::from_secs(1) {
            self.shown
                .call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
    }

    /// Removes the bar. Returns the time since it was made.
    pub fn finish(self) -> Duration {
        self.bar.finish_and_clear();
        self.started.elapsed()
    }
}
