//! The row of one observer: the lookup in f64, the reference that the GPU's is held to.

use crate::Texel;
use crate::axis::{Axis, Stored};
use lensbake_core::{BendAndSlope, EdgeCoordinate, Fate, Observer};

/// One observer's row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    axis: Axis,
    observer: Observer,
    texels: Vec<[f64; 2]>,
}

impl Row {
    pub(crate) fn new(axis: Axis, observer: Observer, texels: Vec<[f64; 2]>) -> Self {
        Row {
            axis,
            observer,
            texels,
        }
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

    /// The texels as a GPU holds them, array of shape `[texels]`.
    pub fn gpu_texels(&self) -> Vec<Texel> {
        self.texels
            .iter()
            .map(|t| [t[0] as f32, t[1] as f32])
            .collect()
    }

    /// The bending Δ at the edge coordinate `at`, rad: cubic Hermite between two texels.
    pub fn bend(&self, at: EdgeCoordinate) -> Fate {
        if at.one_minus_x <= 0.0 {
            return Fate::Captured;
        }
        let stored = self.hermite(self.axis.position(at));
        Fate::Escapes(self.axis.bend(&self.observer, at, stored.value))
    }

    /// The bending and dΔ/dx at the edge coordinate `at`.
    pub fn bend_and_slope(&self, at: EdgeCoordinate) -> Fate<BendAndSlope> {
        if at.one_minus_x <= 0.0 {
            return Fate::Captured;
        }
        let stored = self.hermite(self.axis.position(at));
        Fate::Escapes(self.axis.bending(&self.observer, at, stored))
    }

    /// The stored value at the position q and its derivative by q.
    #[inline]
    fn hermite(&self, q: f64) -> Stored {
        let last = self.texels.len() - 1;
        let position = q.clamp(0.0, 1.0) * last as f64;
        let i = (position as usize).min(last - 1);
        let t = position - i as f64;
        let ([a, slope_a], [b, slope_b]) = (self.texels[i], self.texels[i + 1]);
        let rise = b - a;
        let c2 = 3.0 * rise - 2.0 * slope_a - slope_b;
        let c3 = slope_a + slope_b - 2.0 * rise;
        Stored {
            value: a + t * (slope_a + t * (c2 + t * c3)),
            slope: (slope_a + t * (2.0 * c2 + t * 3.0 * c3)) * last as f64,
        }
    }
}
