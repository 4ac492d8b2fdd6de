//! The chart of speed against accuracy: every method on the same rays, in one run.

pub mod csv;
pub mod figure;
mod labels;
mod marks;
pub mod pareto;
mod plane;
pub mod rays;
mod timing;

use crate::methods::registry::{self, Methods};
use crate::methods::{Card, Method, Outcome};
use lensbake_core::Observer;
use lensbake_tables::TableError;
use lensbake_tables::statistics::ErrorStatistics;
use rayon::prelude::*;
use rays::{Ray, Watcher};

/// How much to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Rays of each set that the errors are taken over.
    pub rays: usize,
    /// Rays of them that are timed.
    pub timed_rays: usize,
    /// Rounds of timing.
    pub rounds: u32,
    /// Least length of one timing, µs.
    pub batch_us: u32,
    /// Seed of the rays.
    pub seed: u64,
}

/// One method on one set of rays.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// What the method says of itself.
    pub card: Card,
    /// Bytes that a frame needs.
    pub bytes: usize,
    /// Time a ray on one thread, ns: the median over the rounds.
    pub ns: f64,
    /// Its relative spread over the rounds: 1.48 × the median absolute deviation.
    pub spread: f64,
    /// Errors on the sky, rad; ∞ for a ray of wrong fate.
    pub radians: ErrorStatistics,
    /// Errors in image space, pixels.
    pub pixels: ErrorStatistics,
    /// Median error on the sky over the rays that do reach it, rad.
    pub median_on_sky: f64,
    /// Rays of wrong fate, unfinished or refused.
    pub lost: usize,
}

/// All methods that serve one observer, on his rays.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Whose rays.
    pub watcher: Watcher,
    /// The methods; the default row first.
    pub entries: Vec<Entry>,
}

impl Section {
    /// The run's own noise: nine in ten methods have less relative spread.
    pub fn noise(&self) -> f64 {
        let mut spreads: Vec<f64> = self.entries.iter().map(|entry| entry.spread).collect();
        spreads.sort_unstable_by(f64::total_cmp);
        spreads.get(spreads.len() * 9 / 10).copied().unwrap_or(0.0)
    }
}

/// Measures every method for the observer at infinity, and those that serve him for each finite one.
/// `step` is called after each step of [`steps`].
///
/// # Errors
/// [`TableError`] if the shipped atlas had no row for an observer, which it has for all.
pub fn measure(effort: &Effort, step: impl Fn() + Sync) -> Result<Vec<Section>, TableError> {
    Watcher::ALL
        .into_iter()
        .map(|watcher| {
            let methods = methods(watcher)?;
            let rays = watcher.rays(effort.rays, effort.seed);
            Ok(section(watcher, &methods, &rays, effort, &step))
        })
        .collect()
}

/// How often [`measure`] calls back.
pub fn steps(effort: &Effort) -> u64 {
    Watcher::ALL.len() as u64 * (1 + u64::from(effort.rounds))
}

fn methods(watcher: Watcher) -> Result<Methods, TableError> {
    let observer: Observer = watcher.observer();
    match watcher {
        Watcher::Far => registry::all(observer),
        Watcher::View(_) => registry::without_rivals(observer),
    }
}

fn section(
    watcher: Watcher,
    methods: &[Box<dyn Method>],
    rays: &[Ray],
    effort: &Effort,
    step: &(impl Fn() + Sync),
) -> Section {
    let answers: Vec<Vec<Outcome>> = methods
        .par_iter()
        .map(|method| rays.iter().map(|ray| method.bend(&ray.launch)).collect())
        .collect();
    step();
    let launches: Vec<_> = rays
        .iter()
        .take(effort.timed_rays)
        .map(|r| r.launch)
        .collect();
    let times = timing::interleaved(methods, &launches, effort, step);
    let entries = methods
        .iter()
        .zip(&answers)
        .zip(times)
        .filter_map(|((method, answers), time)| {
            let errors: Vec<_> = rays.iter().zip(answers).map(|(r, &a)| r.error(a)).collect();
            Some(Entry {
                card: method.card(),
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
    Section { watcher, entries }
}
