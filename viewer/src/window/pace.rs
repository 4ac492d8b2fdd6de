//! When the next frame is due, and how long the last ones were apart.

use super::meter::Meter;
use std::time::{Duration, Instant};
use winit::window::Window;

/// A day away: the panel's way to say that it need not be painted again.
const NEVER: Duration = Duration::from_secs(86_400);
/// When to try again to show a frame that could not be shown, or to look for an answer of the GPU.
const RETRY: Duration = Duration::from_millis(100);
/// Frames a second where the screen does not say how many it shows.
const USUAL_REFRESH_HZ: f64 = 60.0;
/// Where vertical sync does not hold frames back, they are paced a little faster than the screen, so
/// that where it does, the pace is its own.
const PACE: f64 = 0.9;

/// What is left to do after a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Left {
    /// It could not be shown: the window is covered or minimised.
    NotShown,
    /// Something moves, or has changed since it was drawn.
    Unrest,
    /// Nothing moves, but an answer of the GPU is to be looked for soon; the panel wants to be painted again
    /// after this time.
    Awaiting(Duration),
    /// Nothing moves; the panel wants to be painted again after this time.
    Rest(Duration),
}

impl Left {
    /// After what time another frame is due, if it is.
    pub fn wait(self) -> Option<Duration> {
        let wait = match self {
            Left::NotShown => RETRY,
            Left::Unrest => Duration::ZERO,
            Left::Awaiting(again) => RETRY.min(again),
            Left::Rest(again) => again,
        };
        (wait < NEVER).then_some(wait)
    }
}

/// The frames' times.
#[derive(Debug, Default)]
pub struct Pace {
    last: Option<Instant>,
    next: Option<Instant>,
    intervals: Meter,
}

impl Pace {
    /// Begins a frame at `now`, in which something moves or not. Returns how long it has moved since the
    /// last frame.
    pub fn begin(&mut self, now: Instant, moving: bool) -> Duration {
        let since = self.last.map(|last| now - last);
        match since {
            Some(since) => self.intervals.add(since),
            None => self.intervals.clear(),
        }
        self.last = moving.then_some(now);
        self.next = None;
        since.unwrap_or_default()
    }

    /// Schedules the frame after the one that began at `began`.
    pub fn end(&mut self, began: Instant, left: Left, window: &Window) {
        self.next = left.wait().map(|wait| began + wait.max(least_wait(window)));
    }

    /// When the next frame is due, if one is.
    pub fn next(&self) -> Option<Instant> {
        self.next
    }

    /// The mean time between frames while something moves.
    pub fn interval(&self) -> Option<Duration> {
        self.intervals.mean()
    }
}

/// The least time from frame to frame.
fn least_wait(window: &Window) -> Duration {
    let monitor = window.current_monitor();
    let hz = monitor.and_then(|monitor| monitor.refresh_rate_millihertz());
    let hz = hz.map_or(USUAL_REFRESH_HZ, |millihertz| 1e-3 * f64::from(millihertz));
    Duration::from_secs_f64(PACE / hz.max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_rest_no_frame_is_due() {
        assert_eq!(Left::Rest(Duration::MAX).wait(), None);
        assert_eq!(Left::Rest(RETRY).wait(), Some(RETRY));
        assert_eq!(Left::Awaiting(Duration::MAX).wait(), Some(RETRY));
        assert_eq!(Left::Unrest.wait(), Some(Duration::ZERO));
        assert_eq!(Left::NotShown.wait(), Some(RETRY));
    }

    #[test]
    fn a_movement_counts_from_its_first_frame() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut pace = Pace::default();
        assert_eq!(pace.begin(at(0), true), Duration::ZERO);
        assert_eq!(pace.begin(at(20), true), Duration::from_millis(20));
        assert_eq!(pace.begin(at(30), false), Duration::from_millis(10));
        assert_eq!(pace.interval(), Some(Duration::from_millis(15)));
        assert_eq!(pace.begin(at(900), true), Duration::ZERO);
        assert_eq!(pace.interval(), None);
    }
}
