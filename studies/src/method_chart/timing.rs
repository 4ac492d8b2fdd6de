//! Time per ray of the methods. Every round times each method once, so that a machine that slows down slows all of
//! them.

use super::Workload;
use crate::figure::Time;
use crate::methods::{BendingMethod, InitialConditions};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Times `methods` on `initial_conditions`, on the calling thread. `step` is called after each round.
pub fn interleaved(
    methods: &[Box<dyn BendingMethod>],
    initial_conditions: &[InitialConditions],
    workload: &Workload,
    step: &impl Fn(),
) -> Vec<Time> {
    let least = Duration::from_micros(workload.batch_us.into());
    let repeats: Vec<u32> = methods
        .iter()
        .map(|method| repeats(batch(method.as_ref(), initial_conditions, 1), least))
        .collect();
    let mut rounds = vec![Vec::new(); methods.len()];
    for _ in 0..workload.rounds {
        for ((method, &repeats), times) in methods.iter().zip(&repeats).zip(&mut rounds) {
            let elapsed = batch(method.as_ref(), initial_conditions, repeats);
            let rays = initial_conditions.len() as f64 * f64::from(repeats);
            times.push(1e9 * elapsed.as_secs_f64() / rays);
        }
        step();
    }
    rounds.iter().map(|times| Time::of(times)).collect()
}

/// How many times to repeat work that takes `once` so that it lasts at least `least`.
fn repeats(once: Duration, least: Duration) -> u32 {
    let ratio = least.as_secs_f64() / once.as_secs_f64().max(1e-9);
    ratio.ceil().clamp(1.0, 1e6) as u32
}

fn batch(
    method: &dyn BendingMethod,
    initial_conditions: &[InitialConditions],
    repeats: u32,
) -> Duration {
    let started = Instant::now();
    for _ in 0..repeats {
        black_box(method.bend_sum(black_box(initial_conditions)));
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
