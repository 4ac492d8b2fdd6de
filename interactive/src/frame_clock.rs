//! The time between frames.

use crate::meter::Meter;
use std::time::Duration;

/// Measures the time between frames while something moves.
#[derive(Debug, Default)]
pub struct FrameClock {
    /// When the last frame began, if something moved in it.
    last: Option<Duration>,
    intervals: Meter,
}

impl FrameClock {
    /// Begins a frame at `now`, in which something moves if `moving`. Returns the time since the last frame if
    /// something moved in that one, else zero.
    pub fn begin(&mut self, now: Duration, moving: bool) -> Duration {
        let since = self.last.map(|last| now.saturating_sub(last));
        match since {
            Some(since) => self.intervals.add(since),
            None => self.intervals.clear(),
        }
        self.last = moving.then_some(now);
        since.unwrap_or_default()
    }

    /// Forgets the last frame, after a pause in which none were drawn.
    pub fn pause(&mut self) {
        self.last = None;
    }

    /// Whether something moved in the last frame.
    pub fn runs(&self) -> bool {
        self.last.is_some()
    }

    /// The mean time between frames while something moves.
    pub fn interval(&self) -> Option<Duration> {
        self.intervals.mean()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_movement_counts_from_its_first_frame() {
        let at = Duration::from_millis;
        let mut clock = FrameClock::default();
        assert_eq!(clock.begin(at(0), true), Duration::ZERO);
        assert_eq!(clock.begin(at(20), true), Duration::from_millis(20));
        assert_eq!(clock.begin(at(30), false), Duration::from_millis(10));
        assert_eq!(clock.interval(), Some(Duration::from_millis(15)));
        assert_eq!(clock.begin(at(900), true), Duration::ZERO);
        assert_eq!(clock.interval(), None);
    }

    #[test]
    fn a_pause_does_not_count() {
        let at = Duration::from_millis;
        let mut clock = FrameClock::default();
        clock.begin(at(0), true);
        assert!(clock.runs());
        clock.pause();
        assert!(!clock.runs());
        assert_eq!(clock.begin(at(9000), true), Duration::ZERO);
    }
}
