//! How wrong the rays of each contender are on the flight.

use super::{BenchError, CONTENDERS, RADII, scene};
use crate::diff::{Reference, TraceStatistics};
use crate::gpu::Renderer;
use lensbake_tables::Table;

/// Pictures in which the errors are taken: 1/16 of the rays of the usual one are enough to see them.
const SIZE: (u32, u32) = (480, 270);
/// Radii on the flight.
const STOPS: [f64; 4] = [RADII.0, 5.0, 12.0, RADII.1];

/// The largest error of each contender's rays against the closed form over a few stops, as the adapter draws,
/// in pixels of a picture of [`SIZE`] (image space).
pub(super) fn largest(renderer: &Renderer, table: &Table) -> Result<Vec<f64>, BenchError> {
    let mut largest = vec![0f64; CONTENDERS.len()];
    for radius in STOPS {
        let scene = scene(table, radius, SIZE)?;
        let reference = Reference::new(&scene, || ());
        let truth = reference.trace();
        for (contender, largest) in CONTENDERS.iter().zip(&mut largest) {
            let trace = renderer.trace(&scene.by(contender.method), |_| ())?;
            let statistics = TraceStatistics::of(&reference.errors(&trace, &truth));
            // A picture of nothing but the hole has no error.
            let max = statistics.map_or(0.0, |statistics| statistics.pixels.max);
            *largest = largest.max(max);
        }
    }
    Ok(largest)
}
