//! Times of rival pieces of work. Every round times each of them once, so that a machine that slows down slows all of
//! them.

use crate::figure::Time;
use std::time::{Duration, Instant};

/// How long to time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounds {
    /// Number of rounds.
    pub count: u32,
    /// Each piece of work is repeated in a round until it lasts this long.
    pub least: Duration,
}

/// The time of one of the `items` of each batch of `batches`, on the calling thread. `step` is called after each round.
pub fn interleaved(
    batches: &[Box<dyn Fn() + '_>],
    items: usize,
    rounds: Rounds,
    step: &impl Fn(),
) -> Vec<Time> {
    let repeats: Vec<u32> = batches
        .iter()
        .map(|batch| repeats(repeated(batch, 1), rounds.least))
        .collect();
    let mut times = vec![Vec::new(); batches.len()];
    for _ in 0..rounds.count {
        for ((batch, &repeats), times) in batches.iter().zip(&repeats).zip(&mut times) {
            let elapsed = repeated(batch, repeats);
            times.push(1e9 * elapsed.as_secs_f64() / (items as f64 * f64::from(repeats)));
        }
        step();
    }
    times.iter().map(|times| Time::of(times)).collect()
}

/// How many times to repeat work that takes `once` so that it lasts at least `least`.
fn repeats(once: Duration, least: Duration) -> u32 {
    let ratio = least.as_secs_f64() / once.as_secs_f64().max(1e-9);
    ratio.ceil().clamp(1.0, 1e6) as u32
}

fn repeated(batch: &dyn Fn(), repeats: u32) -> Duration {
    let started = Instant::now();
    for _ in 0..repeats {
        batch();
    }
    started.elapsed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_work_is_repeated_and_long_work_is_not() {
        let least = Duration::from_millis(1);
        assert_eq!(repeats(Duration::from_micros(10), least), 100);
        assert_eq!(repeats(Duration::from_secs(1), least), 1);
        assert_eq!(repeats(Duration::ZERO, least), 1_000_000);
    }
}
