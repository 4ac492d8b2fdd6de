//! The row of one observer: the lookup in f64, the reference that the GPU's is held to.

use crate::axis::{Axis, Stored};
use crate::header::check_texels;
use crate::{Interpolation, TableError, Texel};
use lensbake_core::{BendAndSlope, EdgeCoordinate, Fate, Observer};

/// One observer's row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    axis: Axis,
    observer: Observer,
    texels: Vec<[f64; 2]>,
    interpolation: Interpolation,
}

impl Row {
    pub(crate) fn new(axis: Axis, observer: Observer, texels: Vec<[f64; 2]>) -> Self {
        Row {
            axis,
            observer,
            texels,
            interpolation: Interpolation::Hermite,
        }
    }

    /// The same row with another number of texels, read by `interpolation`: each new texel is looked
    /// up in this row.
    ///
    /// # Errors
    /// [`TableError::Size`] if a table could not have so many texels in a row.
    pub fn resampled(&self, texels: u32, interpolation: Interpolation) -> Result<Self, TableError> {
        check_texels(texels)?;
        let last = f64::from(texels - 1);
        let resampled = (0..texels).map(|i| {
            let stored = self.stored(f64::from(i) / last);
            [stored.value, stored.slope / last]
        });
        Ok(Row {
            texels: resampled.collect(),
            interpolation,
            ..*self
        })
    }

    /// Whose row it is.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }

    /// The axis.
    pub fn axis(&self) -> Axis {
        self.axis
    }

    /// Number of texels.
    pub fn texel_count(&self) -> u32 {
        self.texels.len() as u32
    }

    /// How it is read between two texels: Hermite unless it was resampled otherwise.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Bytes of the row on a GPU.
    pub fn gpu_bytes(&self) -> usize {
        self.texels.len() * self.interpolation.texel_bytes()
    }

    /// The texels as a GPU holds them, array of shape `[texels]`.
    pub fn gpu_texels(&self) -> Vec<Texel> {
        self.texels
            .iter()
            .map(|t| [t[0] as f32, t[1] as f32])
            .collect()
    }

    /// The bending Δ at the edge coordinate `at`, rad.
    #[inline]
    pub fn bend(&self, at: EdgeCoordinate) -> Fate {
        if at.one_minus_x <= 0.0 {
            return Fate::Captured;
        }
        let stored = self.stored(self.axis.position(at));
        Fate::Escapes(self.axis.bend(&self.observer, at, stored.value))
    }

    /// The bending and dΔ/dx at the edge coordinate `at`.
    pub fn bend_and_slope(&self, at: EdgeCoordinate) -> Fate<BendAndSlope> {
        if at.one_minus_x <= 0.0 {
            return Fate::Captured;
        }
        if let (Axis::Residual, Some(bending)) = (self.axis, self.observer.bend_straight_away(at)) {
            return Fate::Escapes(bending);
        }
        let stored = self.stored(self.axis.position(at));
        Fate::Escapes(self.axis.bending(&self.observer, at, stored))
    }

    /// The stored value at the position q and its derivative by q.
    #[inline]
    fn stored(&self, q: f64) -> Stored {
        self.interpolation.between(&self.texels, q)
    }
}
