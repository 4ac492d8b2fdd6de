//! Time a ray, all methods interleaved: in every round each has its turn, so that a machine that slows
//! down slows all of them.

use super::Effort;
use crate::methods::{Launch, Method};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Time a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// Median over the rounds, ns.
    pub ns: f64,
    /// Relative spread: 1.48 × the median absolute deviation, over the median.
    pub spread: f64,
}

/// Times `methods` on `launches`, on the calling thread; `step` is called after each round.
pub fn interleaved(
    methods: &[Box<dyn Method>],
    launches: &[Launch],
    effort: &Effort,
    step: &impl Fn(),
) -> Vec<Time> {
    let least = Duration::from_micros(effort.batch_us.into());
    let repeats: Vec<u32> = methods
        .iter()
        .map(|method| repeats(batch(method.as_ref(), launches, 1), least))
        .collect();
    let mut rounds = vec![Vec::new(); methods.len()];
    for _ in 0..effort.rounds {
        for ((method, &repeats), times) in methods.iter().zip(&repeats).zip(&mut rounds) {
            let elapsed = batch(method.as_ref(), launches, repeats);
            let rays = launches.len() as f64 * f64::from(repeats);
            times.push(1e9 * elapsed.as_secs_f64() / rays);
        }
        step();
    }
    rounds.iter().map(|times| Time::of(times)).collect()
}

/// How often to repeat what takes `once` so that it lasts `least`.
fn repeats(once: Duration, least: Duration) -> u32 {
    let ratio = least.as_secs_f64() / once.as_secs_f64().max(1e-9);
    ratio.ceil().clamp(1.0, 1e6) as u32
}

fn batch(method: &dyn Method, launches: &[Launch], repeats: u32) -> Duration {
    let started = Instant::now();
    for _ in 0..repeats {
        black_box(method.bend_sum(black_box(launches)));
    }
    started.elapsed()
}

impl Time {
    fn of(times: &[f64]) -> Self {
        let ns = median(times.to_vec());
        let deviation = median(times.iter().map(|t| (t - ns).abs()).collect());
        Time {
            ns,
            spread: 1.48 * deviation / ns,
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_round_changes_neither_time_nor_spread_much() {
        let time = Time::of(&[10.0, 10.1, 9.9, 10.0, 90.0]);
        assert_eq!(time.ns, 10.0);
        assert!(time.spread < 0.02);
    }

    #[test]
    fn short_work_is_repeated_and_long_work_is_not() {
        let least = Duration::from_millis(1);
        assert_eq!(repeats(Duration::from_micros(10), least), 100);
        assert_eq!(repeats(Duration::from_secs(1), least), 1);
        assert_eq!(repeats(Duration::ZERO, least), 1_000_000);
    }
}
