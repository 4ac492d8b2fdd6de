//! The default row, looked up for many rays at once: in f64, and in f32.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::{Observer, RayOutcome, ShadowCoordinate};
use lensbake_tables::{Row, TableError, default_atlas};
use std::cell::RefCell;
use std::hint::black_box;

/// The numbers that a lookup computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// f32, from 1 − x alone.
    Single,
    /// f64.
    Double,
}

/// The shipped atlas's row of one observer, looked up for many rays at once.
#[derive(Debug, Clone)]
pub struct RowInBatches {
    row: Row,
    precision: Precision,
}

impl RowInBatches {
    /// The row for `observer`.
    ///
    /// # Errors
    /// [`TableError`] if the shipped atlas has no row for `observer`; it has one for every observer.
    pub fn new(observer: Observer, precision: Precision) -> Result<Self, TableError> {
        Ok(RowInBatches {
            row: default_atlas().row(observer)?,
            precision,
        })
    }
}

impl BendingMethod for RowInBatches {
    fn info(&self) -> MethodInfo {
        let precision = match self.precision {
            Precision::Single => "f32",
            Precision::Double => "f64",
        };
        MethodInfo {
            name: "lensbake default row, many rays at once".to_owned(),
            knobs: precision.to_owned(),
            source: "this project: lensbake_tables::RowBatch",
            family: Family::Table,
            landmark: true,
        }
    }

    fn bytes(&self) -> usize {
        // The four coefficients of each interval.
        let number = match self.precision {
            Precision::Single => size_of::<f32>(),
            Precision::Double => size_of::<f64>(),
        };
        4 * number * (self.row.texel_count() as usize - 1)
    }

    fn serves(&self, observer: &Observer) -> bool {
        self.row.observer() == observer
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        let at = match initial.ray {
            Ok(_) => initial.at,
            Err(error) => return MethodOutcome::Refused(error),
        };
        let bend = match self.precision {
            Precision::Single => self.row.bend_many_f32(&[at.one_minus_x as f32])[0].into(),
            Precision::Double => self.row.bend_many(&[at])[0],
        };
        match at.one_minus_x <= 0.0 {
            true => RayOutcome::Captured.into(),
            false => RayOutcome::Escapes(bend).into(),
        }
    }

    fn timed<'a>(&'a self, initial_conditions: &'a [InitialConditions]) -> Box<dyn Fn() + 'a> {
        let at: Vec<ShadowCoordinate> = initial_conditions.iter().map(|i| i.at).collect();
        match self.precision {
            Precision::Single => {
                let at: Vec<f32> = at.iter().map(|at| at.one_minus_x as f32).collect();
                let (batch, bends) = (self.row.batch_f32(), RefCell::new(vec![0.0; at.len()]));
                Box::new(move || {
                    batch.bend(black_box(&at), &mut bends.borrow_mut());
                    black_box(&bends);
                })
            }
            Precision::Double => {
                let (batch, bends) = (self.row.batch(), RefCell::new(vec![0.0; at.len()]));
                Box::new(move || {
                    batch.bend(black_box(&at), &mut bends.borrow_mut());
                    black_box(&bends);
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::default_row::DefaultRow;

    #[test]
    fn many_rays_are_off_by_no_more_than_one() {
        let far = Observer::at_infinity();
        let row = DefaultRow::new(far).unwrap();
        let batches = [Precision::Double, Precision::Single]
            .map(|precision| RowInBatches::new(far, precision).unwrap());
        for b in [2.598_08, 2.6, 3.0, 40.0] {
            let initial = InitialConditions::from_infinity(b);
            let one = row.bend(&initial).bend().unwrap();
            let [double, single] = [0, 1].map(|i: usize| batches[i].bend(&initial).bend().unwrap());
            assert!((double - one).abs() < 1e-14, "{b}: {double} {one}");
            assert!((single - one).abs() < 1e-6, "{b}: {single} {one}");
        }
        for batch in &batches {
            let captured = batch.bend(&InitialConditions::from_infinity(2.0));
            assert_eq!(captured, MethodOutcome::Captured);
            batch.timed(&[InitialConditions::from_infinity(5.0); 3])();
        }
    }
}
