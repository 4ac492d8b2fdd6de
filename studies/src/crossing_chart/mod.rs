//! Chart of speed against accuracy of the methods that find where a ray crosses a disc: every method on the same
//! crossings, in one run.

pub mod csv;
pub mod figure;
mod marks;
pub mod rays;

use crate::crossing_methods::{CrossingInfo, CrossingMethod, Questions, label, registry};
use crate::figure::Time;
use crate::timing::{self, Rounds};
use lensbake_tables::statistics::ErrorStatistics;
use rayon::prelude::*;
use rays::{Error, OBSERVERS, Sample};
use std::hint::black_box;

/// How much to measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Workload {
    /// Crossings per observer.
    pub crossings: usize,
    /// How many of these are timed.
    pub timed: usize,
    /// The rounds of timing.
    pub rounds: Rounds,
    /// Seed of the random rays.
    pub seed: u64,
}

/// Errors over a set of crossings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingErrors {
    /// Relative errors of the radius.
    pub relative: ErrorStatistics,
    /// Errors in image space, pixels.
    pub pixels: ErrorStatistics,
}

impl CrossingErrors {
    fn of(errors: &[Error]) -> Option<Self> {
        Some(CrossingErrors {
            relative: ErrorStatistics::of(errors.iter().map(|e| e.relative))?,
            pixels: ErrorStatistics::of(errors.iter().map(|e| e.pixels))?,
        })
    }
}

/// Measurements of one method.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredCrossing {
    /// Description of the method.
    pub info: CrossingInfo,
    /// Name, arithmetic and parameters.
    pub label: String,
    /// Bits of the numbers it computes with.
    pub bits: usize,
    /// Bytes of data that it needs.
    pub bytes: usize,
    /// Time per crossing on one thread.
    pub time: Time,
    /// Errors over the crossings of each of [`OBSERVERS`].
    pub by_observer: Vec<CrossingErrors>,
    /// Errors over all crossings.
    pub errors: CrossingErrors,
}

/// What was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossingChart {
    /// The methods, in the order of [`registry::all`].
    pub entries: Vec<MeasuredCrossing>,
    /// What rounding 1/b and the phase to f32 does, which the errors of the methods do not include.
    pub rounding: CrossingErrors,
}

/// Measures the methods of [`registry::all`]. `step` is called [`steps`] times. `None` without crossings.
pub fn measure(workload: &Workload, step: impl Fn() + Sync) -> Option<CrossingChart> {
    let methods = registry::all();
    let samples: Vec<Vec<Sample>> = OBSERVERS
        .par_iter()
        .map(|&radius| rays::samples(radius, workload.crossings, workload.seed))
        .collect();
    step();
    let times = times(&methods, &samples, workload, &step);
    let pairs = methods.iter().zip(times);
    let entries = pairs.map(|(method, time)| measured(method.as_ref(), time, &samples));
    let rounding: Vec<Error> = samples
        .iter()
        .flatten()
        .map(Sample::rounding_error)
        .collect();
    Some(CrossingChart {
        entries: entries.collect::<Option<_>>()?,
        rounding: CrossingErrors::of(&rounding)?,
    })
}

fn measured(
    method: &dyn CrossingMethod,
    time: Time,
    samples: &[Vec<Sample>],
) -> Option<MeasuredCrossing> {
    let errors: Vec<Vec<Error>> = samples.iter().map(|s| errors(method, s)).collect();
    Some(MeasuredCrossing {
        info: method.info(),
        label: label(method),
        bits: method.bits(),
        bytes: method.bytes(),
        time,
        by_observer: errors
            .iter()
            .filter_map(|e| CrossingErrors::of(e))
            .collect(),
        errors: CrossingErrors::of(&errors.concat())?,
    })
}

/// How many times [`measure`] calls `step`.
pub fn steps(workload: &Workload) -> u64 {
    1 + u64::from(workload.rounds.count)
}

fn questions<'a>(samples: impl IntoIterator<Item = &'a Sample>) -> Questions {
    Questions::new(samples.into_iter().map(|sample| sample.question).collect())
}

fn errors(method: &dyn CrossingMethod, samples: &[Sample]) -> Vec<Error> {
    let answers = method.answers(&questions(samples));
    let pairs = samples.iter().zip(answers);
    pairs.map(|(sample, u)| sample.error(u)).collect()
}

/// The times of the methods on crossings of all observers.
fn times(
    methods: &[Box<dyn CrossingMethod>],
    samples: &[Vec<Sample>],
    workload: &Workload,
    step: &impl Fn(),
) -> Vec<Time> {
    let timed = questions(samples.iter().flat_map(|s| s.iter().take(workload.timed)));
    let batches: Vec<_> = methods
        .iter()
        .map(|method| batch(method.as_ref(), &timed))
        .collect();
    timing::interleaved(&batches, timed.pairs().len(), workload.rounds, step)
}

/// The work that is timed.
fn batch<'a>(method: &'a dyn CrossingMethod, questions: &'a Questions) -> Box<dyn Fn() + 'a> {
    Box::new(|| {
        black_box(method.sum(black_box(questions)));
    })
}
