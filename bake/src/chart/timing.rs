//! Time a ray, all methods interleaved: in every round each has its turn, so that a machine that slows
//! down slows all of them.

use super::Effort;
use crate::methods::{Launch, Method};
use lensbake_report::Time;
use std::hint::black_box;
use std::time::{Duration, Instant};

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
