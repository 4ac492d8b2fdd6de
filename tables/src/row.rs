//! The row of one observer: the lookup in f64, which is the reference for the lookup on a GPU.

use crate::axis::{Axis, Stored};
use crate::header::check_texels;
use crate::interpolation::septic;
use crate::lookup::{HorizonSide, RowShape};
use crate::{Interpolation, RowFormat, TableError, Texel};
use lensbake_core::{BendAndSlope, Observer, RayOutcome, ShadowCoordinate};

/// Texels of the row of a moving observer for each texel of the table.
const FRAME_REFINEMENT: usize = 4;

/// The row of one observer.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    axis: Axis,
    observer: Observer,
    texels: Vec<[f64; 2]>,
    interpolation: Interpolation,
    format: RowFormat,
}

impl Row {
    pub(crate) fn new(axis: Axis, observer: Observer, texels: Vec<[f64; 2]>) -> Self {
        Row {
            axis,
            observer,
            texels,
            interpolation: Interpolation::Hermite,
            format: RowFormat::Float32,
        }
    }

    /// The same row for `observer`, who must have the same view angles.
    pub(crate) fn with_observer(self, observer: Observer) -> Self {
        Row { observer, ..self }
    }

    /// The row for `observer` in another radial motion at the same radius: the bending Δ = θ − θ′ changes by the
    /// difference of the two view angles θ at the same x, which is added at each texel. Each interval between texels is
    /// divided into [`FRAME_REFINEMENT`], because that difference is narrow for a distant observer, and pixels straight
    /// away from a near one are small. On the residual axis only; the others are for the observer at infinity, who is at rest.
    pub(crate) fn in_frame_of(self, observer: Observer) -> Self {
        let count = (self.texels.len() - 1) * FRAME_REFINEMENT + 1;
        let last = (count - 1) as f64;
        let texels = (0..count).map(|i| {
            let q = i as f64 / last;
            let (stored, aberration) = (septic(&self.texels, q), self.aberration(&observer, q));
            [
                stored.value + aberration.value,
                (stored.slope + aberration.slope) / last,
            ]
        });
        Row {
            texels: texels.collect(),
            observer,
            ..self
        }
    }

    /// θ of `observer` minus θ of the row's observer at the position q, and its derivative with respect to q.
    fn aberration(&self, observer: &Observer, q: f64) -> Stored {
        let x = self.axis.shadow_coordinate(observer, q).x;
        let (to, from) = (observer, &self.observer);
        let slope = to.view_angle_slope(x) - from.view_angle_slope(x);
        Stored {
            value: to.view_angle(x) - from.view_angle(x),
            slope: slope * self.axis.shadow_coordinate_slope(observer, q),
        }
    }

    /// The row resampled to another number of texels, to be read with `interpolation`. Each new texel is looked up
    /// in this row. On a GPU it is stored in 32-bit floats.
    ///
    /// # Errors
    /// [`TableError::Size`] if a row cannot have this number of texels.
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
            format: RowFormat::Float32,
            ..*self
        })
    }

    /// The same row, to be stored in `format` on a GPU. The lookup in f64 does not change.
    pub fn in_format(self, format: RowFormat) -> Self {
        Row { format, ..self }
    }

    /// The observer that the row is for.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }

    /// The axis.
    pub fn axis(&self) -> Axis {
        self.axis
    }

    /// The texels: values and slopes per texel.
    pub(crate) fn texels(&self) -> &[[f64; 2]] {
        &self.texels
    }

    /// Number of texels.
    pub fn texel_count(&self) -> u32 {
        self.texels.len() as u32
    }

    /// Interpolation between texels: Hermite unless the row was resampled with another.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Format of the texels on a GPU: 32-bit floats unless it was changed by [`Row::in_format`].
    pub fn format(&self) -> RowFormat {
        self.format
    }

    /// The shape that a shader must be specialised for in order to look up this row.
    pub fn shape(&self) -> RowShape {
        RowShape {
            texels: self.texel_count(),
            interpolation: self.interpolation,
            side: HorizonSide::of(&self.observer),
            format: self.format,
        }
    }

    /// Size of the row on a GPU in bytes.
    pub fn gpu_bytes(&self) -> usize {
        self.texels.len() * self.format.texel_bytes(self.interpolation)
    }

    /// The texels in 32-bit floats, array of shape `[texels]`.
    pub fn gpu_texels(&self) -> Vec<Texel> {
        self.texels
            .iter()
            .map(|t| [t[0] as f32, t[1] as f32])
            .collect()
    }

    /// The bending Δ (deflection angle) at the normalised shadow coordinate `at`, rad.
    #[inline]
    pub fn bend(&self, at: ShadowCoordinate) -> RayOutcome {
        if at.one_minus_x <= 0.0 {
            return RayOutcome::Captured;
        }
        let at = self.axis.row_coordinate(&self.observer, at);
        let stored = self.stored(self.axis.position(at));
        RayOutcome::Escapes(self.axis.bend(&self.observer, at, stored.value))
    }

    /// The bending Δ at the normalised shadow coordinate `at` for `observer`, who may be in any radial motion at the
    /// radius of this row, rad: that of the row's own observer and the exact difference of the two view angles. With
    /// the row of [`Observer::in_row_frame`] it is more accurate than the row that [`crate::Table::row`] makes for the
    /// motion.
    pub fn bend_for(&self, observer: &Observer, at: ShadowCoordinate) -> RayOutcome {
        let bend = self.bend(at);
        if observer.is_at_rest() && self.observer.is_at_rest() {
            return bend;
        }
        let aberration = observer.view_angle(at.x) - self.observer.view_angle(at.x);
        bend.map(|bend| bend + aberration)
    }

    /// The bending Δ and dΔ/dx at the normalised shadow coordinate `at`.
    pub fn bend_and_slope(&self, at: ShadowCoordinate) -> RayOutcome<BendAndSlope> {
        if at.one_minus_x <= 0.0 {
            return RayOutcome::Captured;
        }
        let away = self.observer.bend_straight_away(at);
        if let Some(bending) = away.filter(|_| self.axis.is_residual()) {
            return RayOutcome::Escapes(bending);
        }
        let at = self.axis.row_coordinate(&self.observer, at);
        let stored = self.stored(self.axis.position(at));
        RayOutcome::Escapes(self.axis.bending(&self.observer, at, stored))
    }

    /// The stored value at the position q and its derivative with respect to q.
    #[inline]
    fn stored(&self, q: f64) -> Stored {
        self.interpolation.between(&self.texels, q)
    }
}
