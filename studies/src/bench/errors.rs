//! Errors of each contender's rays on the flight.

use super::{BenchError, CONTENDERS, RADII, lens};
use lensbake_core::Motion;
use lensbake_render::diff::{Reference, TraceStatistics};
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::Lens;
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
        let mut references = References::new(table, radius);
        for (contender, largest) in CONTENDERS.iter().zip(&mut largest) {
            let (lens, reference) = references.of(contender.motion)?;
            let trace = renderer
                .clone()
                .in_pass(contender.pass(renderer))
                .trace(&lens.with_deflection(contender.deflection), |_| ())
                .await?;
            let statistics = TraceStatistics::of(&reference.errors(&trace, &reference.trace()));
            // A picture that shows only the hole has no error.
            let max = statistics.map_or(0.0, |statistics| statistics.pixels.max);
            *largest = largest.max(max);
        }
    }
    Ok(largest)
}

/// The lenses and the references of the motions at one radius.
struct References<'a> {
    table: &'a Table,
    radius: f64,
    known: Vec<(Motion, Lens, Reference)>,
}

impl<'a> References<'a> {
    fn new(table: &'a Table, radius: f64) -> Self {
        References {
            table,
            radius,
            known: Vec::new(),
        }
    }

    /// The lens and the reference of a camera in this motion, computed the first time.
    fn of(&mut self, motion: Motion) -> Result<(&Lens, &Reference), BenchError> {
        let known = self.known.iter().position(|(of, ..)| *of == motion);
        let index = match known {
            Some(index) => index,
            None => {
                let lens = lens(self.table, self.radius, motion, SIZE)?;
                let reference = Reference::new(&lens, || ());
                self.known.push((motion, lens, reference));
                self.known.len() - 1
            }
        };
        let (_, lens, reference) = &self.known[index];
        Ok((lens, reference))
    }
}
