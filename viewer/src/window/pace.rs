//! Frame pacing: when the next frame is due.

use std::time::{Duration, Instant};
use winit::window::Window;

/// A repaint delay of a day or more means that egui needs no repaint.
const NEVER: Duration = Duration::from_secs(86_400);
/// Delay before the next attempt to show a frame, or to poll the GPU for a result.
const RETRY: Duration = Duration::from_millis(100);
/// Assumed refresh rate if the monitor reports none.
const USUAL_REFRESH_HZ: f64 = 60.0;
/// Shortest time between frames, as a part of the refresh interval. It is below 1 so that vertical sync, where it
/// works, sets the pace.
const PACE: f64 = 0.9;

/// What is left to do after a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AfterFrame {
    /// The frame could not be shown: the window is covered or minimised.
    NotShown,
    /// Something moves, or has changed since the frame was drawn.
    Moving,
    /// Nothing moves, but a result of the GPU is expected soon; the panel wants a repaint after this time.
    Awaiting(Duration),
    /// Nothing moves; the panel wants a repaint after this time.
    Idle(Duration),
}

impl AfterFrame {
    /// Time until the next frame is due; `None` if none is.
    pub fn wait(self) -> Option<Duration> {
        let wait = match self {
            AfterFrame::NotShown => RETRY,
            AfterFrame::Moving => Duration::ZERO,
            AfterFrame::Awaiting(again) => RETRY.min(again),
            AfterFrame::Idle(again) => again,
        };
        (wait < NEVER).then_some(wait)
    }
}

/// When the next frame is due.
#[derive(Debug, Default)]
pub struct Pace {
    next: Option<Instant>,
}

impl Pace {
    /// Begins a frame: none is due until it has ended.
    pub fn begin(&mut self) {
        self.next = None;
    }

    /// Schedules the frame after the one that began at `began`.
    pub fn end(&mut self, began: Instant, after: AfterFrame, window: &Window) {
        self.next = after
            .wait()
            .map(|wait| began + wait.max(least_wait(window)));
    }

    /// When the next frame is due, if one is.
    pub fn next(&self) -> Option<Instant> {
        self.next
    }
}

/// Shortest time from frame to frame.
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
        assert_eq!(AfterFrame::Idle(Duration::MAX).wait(), None);
        assert_eq!(AfterFrame::Idle(RETRY).wait(), Some(RETRY));
        assert_eq!(AfterFrame::Awaiting(Duration::MAX).wait(), Some(RETRY));
        assert_eq!(AfterFrame::Moving.wait(), Some(Duration::ZERO));
        assert_eq!(AfterFrame::NotShown.wait(), Some(RETRY));
    }
}
