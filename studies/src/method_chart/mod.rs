//! Chart of speed against accuracy: every method on the same rays, in one run.

pub mod csv;
pub mod figure;
mod marks;
pub mod rays;
pub mod rivals;

use crate::methods::registry::{self, Methods};
use crate::methods::{BendingMethod, MethodInfo, MethodOutcome};
use crate::timing::{self, Rounds};
use lensbake_tables::TableError;
use lensbake_tables::statistics::ErrorStatistics;
use rayon::prelude::*;
use rays::{ChartObserver, Ray};
use std::time::Duration;

/// How much to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Workload {
    /// Number of rays per observer, over which the errors are taken.
    pub rays: usize,
    /// How many of these rays are timed.
    pub timed_rays: usize,
    /// Rounds of timing.
    pub rounds: u32,
    /// Minimum duration of one timing, µs.
    pub batch_us: u32,
    /// Seed of the random rays.
    pub seed: u64,
}

/// Measurements of one method on one set of rays.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredMethod {
    /// Description of the method.
    pub info: MethodInfo,
    /// Bytes of data per frame.
    pub bytes: usize,
    /// Time per ray on one thread, ns: the median over the rounds.
    pub ns: f64,
    /// Relative spread of the time over the rounds: 1.48 × the median absolute deviation, over the median.
    pub spread: f64,
    /// Errors on the sky, rad; ∞ for a ray that is counted in `lost`.
    pub radians: ErrorStatistics,
    /// Errors in image space, pixels.
    pub pixels: ErrorStatistics,
    /// Median error on the sky over the rays that escape both in truth and by this method, rad.
    pub median_on_sky: f64,
    /// Number of rays with a wrong outcome, a NaN, or no outcome (unfinished or refused).
    pub lost: usize,
}

/// Measurements of the methods on the rays of one observer.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The observer.
    pub observer: ChartObserver,
    /// The methods; the default row first.
    pub entries: Vec<MeasuredMethod>,
}

impl Section {
    /// The noise of this run: 90 % of the methods have a smaller relative spread.
    pub fn noise(&self) -> f64 {
        let mut spreads: Vec<f64> = self.entries.iter().map(|entry| entry.spread).collect();
        spreads.sort_unstable_by(f64::total_cmp);
        spreads.get(spreads.len() * 9 / 10).copied().unwrap_or(0.0)
    }
}

/// Measures the methods of [`registry::all`] for the observer at infinity, and those of
/// [`registry::without_compared_tables`] for each finite one. `step` is called [`steps`] times.
///
/// # Errors
/// [`TableError`] if the shipped atlas has no row for an observer; it has one for every observer.
pub fn measure(workload: &Workload, step: impl Fn() + Sync) -> Result<Vec<Section>, TableError> {
    ChartObserver::ALL
        .into_iter()
        .map(|observer| {
            let methods = methods(observer)?;
            let rays = observer.rays(workload.rays, workload.seed);
            Ok(section(observer, &methods, &rays, workload, &step))
        })
        .collect()
}

/// How many times [`measure`] calls `step`.
pub fn steps(workload: &Workload) -> u64 {
    ChartObserver::ALL.len() as u64 * (1 + u64::from(workload.rounds))
}

fn methods(observer: ChartObserver) -> Result<Methods, TableError> {
    match observer {
        ChartObserver::Far => registry::all(observer.observer()),
        ChartObserver::View(_) => registry::without_compared_tables(observer.observer()),
    }
}

fn section(
    observer: ChartObserver,
    methods: &[Box<dyn BendingMethod>],
    rays: &[Ray],
    workload: &Workload,
    step: &(impl Fn() + Sync),
) -> Section {
    let answers: Vec<Vec<MethodOutcome>> = methods
        .par_iter()
        .map(|method| rays.iter().map(|ray| method.bend(&ray.initial)).collect())
        .collect();
    step();
    let initial_conditions: Vec<_> = rays
        .iter()
        .take(workload.timed_rays)
        .map(|r| r.initial)
        .collect();
    let batches: Vec<_> = methods
        .iter()
        .map(|method| method.timed(&initial_conditions))
        .collect();
    let rounds = Rounds {
        count: workload.rounds,
        least: Duration::from_micros(workload.batch_us.into()),
    };
    let times = timing::interleaved(&batches, initial_conditions.len(), rounds, step);
    let entries = methods
        .iter()
        .zip(&answers)
        .zip(times)
        .filter_map(|((method, answers), time)| {
            let errors: Vec<_> = rays.iter().zip(answers).map(|(r, &a)| r.error(a)).collect();
            Some(MeasuredMethod {
                info: method.info(),
                bytes: method.bytes(),
                ns: time.ns,
                spread: time.spread,
                radians: ErrorStatistics::of(errors.iter().map(|e| e.radians))?,
                pixels: ErrorStatistics::of(errors.iter().map(|e| e.pixels))?,
                median_on_sky: rays::median_on_sky(rays.iter().zip(answers.iter().copied())),
                lost: errors.iter().filter(|e| !e.radians.is_finite()).count(),
            })
        })
        .collect();
    Section { observer, entries }
}
