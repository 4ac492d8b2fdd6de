//! The default row: lookup in the shipped atlas's row for the observer.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::Observer;
use lensbake_tables::{Row, TableError, Texel, default_atlas};

/// The shipped atlas's row of one observer.
#[derive(Debug, Clone)]
pub struct DefaultRow {
    row: Row,
    bytes: usize,
}

impl DefaultRow {
    /// The row for `observer`.
    ///
    /// # Errors
    /// [`TableError`] if the shipped atlas has no row for `observer`; it has one for every observer.
    pub fn new(observer: Observer) -> Result<Self, TableError> {
        let atlas = default_atlas();
        Ok(DefaultRow {
            row: atlas.row(observer)?,
            bytes: atlas.header().texels as usize * size_of::<Texel>(),
        })
    }
}

impl BendingMethod for DefaultRow {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "lensbake default row".to_owned(),
            knobs: "residual, Hermite, 64 × f32".to_owned(),
            source: "this project: lensbake_tables::Row",
            family: Family::Table,
            landmark: true,
        }
    }

    fn bytes(&self) -> usize {
        self.bytes
    }

    fn serves(&self, observer: &Observer) -> bool {
        self.row.observer() == observer
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        match initial.ray {
            Ok(_) => self.row.bend(initial.at).into(),
            Err(error) => MethodOutcome::Refused(error),
        }
    }
}
