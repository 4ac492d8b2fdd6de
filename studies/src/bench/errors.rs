//! Errors of each contender's rays on the flight.

use super::{BenchError, CONTENDERS, RADII, lens};
use lensbake_render::diff::{Reference, TraceStatistics};
use lensbake_render::gpu::Renderer;
use lensbake_tables::Table;

/// Size of the pictures in which the errors are taken: 1/16 of the rays of 1920 × 1080 are enough.
const SIZE: (u32, u32) = (480, 270);
/// Radii on the flight at which the errors are taken.
const STOPS: [f64; 4] = [RADII.0, 5.0, 12.0, RADII.1];

/// The largest error of each contender's rays against the closed form over all [`STOPS`], as drawn by the adapter,
/// in pixels of a picture of [`SIZE`] (image space).
pub(super) async fn largest(renderer: &Renderer, table: &Table) -> Result<Vec<f64>, BenchError> {
    let mut largest = vec![0f64; CONTENDERS.len()];
    for radius in STOPS {
        let lens = lens(table, radius, SIZE)?;
        let reference = Reference::new(&lens, || ());
        let truth = reference.trace();
        for (contender, largest) in CONTENDERS.iter().zip(&mut largest) {
            let trace = renderer
                .trace(&lens.with_deflection(contender.deflection), |_| ())
                .await?;
            let statistics = TraceStatistics::of(&reference.errors(&trace, &truth));
            // A picture that shows only the hole has no error.
            let max = statistics.map_or(0.0, |statistics| statistics.pixels.max);
            *largest = largest.max(max);
        }
    }
    Ok(largest)
}
