//! The product's own lookup: the row that the shipped atlas has for the observer.

use super::{Card, Family, Launch, Method, Outcome};
use lensbake_core::Observer;
use lensbake_tables::{Row, TableError, Texel, default_atlas};

/// The row of one observer.
#[derive(Debug, Clone)]
pub struct DefaultRow {
    row: Row,
    bytes: usize,
}

impl DefaultRow {
    /// The row for `observer`.
    ///
    /// # Errors
    /// [`TableError`], which the atlas for all observers never gives.
    pub fn new(observer: Observer) -> Result<Self, TableError> {
        let atlas = default_atlas();
        Ok(DefaultRow {
            row: atlas.row(observer)?,
            bytes: atlas.header().texels as usize * size_of::<Texel>(),
        })
    }
}

impl Method for DefaultRow {
    fn card(&self) -> Card {
        Card {
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

    fn bend(&self, launch: &Launch) -> Outcome {
        match launch.ray {
            Ok(_) => self.row.bend(launch.at).into(),
            Err(error) => Outcome::Refused(error),
        }
    }
}
