//! Moving averages of frame times, for the panel.

use std::time::Duration;

/// Number of frames in an average.
const FRAMES: usize = 30;

/// A moving average of times.
#[derive(Debug, Clone, Default)]
pub struct Meter {
    times: [Duration; FRAMES],
    filled: usize,
    next: usize,
}

impl Meter {
    /// Adds a time.
    pub fn add(&mut self, time: Duration) {
        self.times[self.next] = time;
        self.next = (self.next + 1) % FRAMES;
        self.filled = (self.filled + 1).min(FRAMES);
    }

    /// Removes all times.
    pub fn clear(&mut self) {
        self.filled = 0;
        self.next = 0;
    }

    /// The average; `None` if there are no times.
    pub fn mean(&self) -> Option<Duration> {
        let sum: Duration = self.times[..self.filled].iter().sum();
        (self.filled > 0).then(|| sum / self.filled as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_of_the_last_frames() {
        let mut meter = Meter::default();
        assert_eq!(meter.mean(), None);
        for ms in 1..=100 {
            meter.add(Duration::from_millis(ms));
        }
        assert_eq!(meter.mean(), Some(Duration::from_micros(85_500)));
        meter.clear();
        meter.add(Duration::from_millis(7));
        assert_eq!(meter.mean(), Some(Duration::from_millis(7)));
    }
}
