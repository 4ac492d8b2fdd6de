//! The axes of the compared tables: the shipped one, the naive ones, and the residual against s.

use lensbake_core::{BendAndSlope, Observer, ShadowCoordinate};
use lensbake_tables::{Axis, Stored};

/// The variable along which a table's texels are spaced, and the quantity that they store.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowAxis {
    /// An axis that `bake` offers.
    Baked(Axis),
    /// s = √(1−x), storing R = Δ + 2 ln s: only the leading logarithm is subtracted.
    ResidualS,
}

impl RowAxis {
    /// Name in the CSV files and the figures.
    pub fn name(self) -> &'static str {
        match self {
            RowAxis::Baked(Axis::Residual | Axis::ResidualBelow) => "the residual",
            RowAxis::Baked(Axis::UniformB { .. }) => "b",
            RowAxis::Baked(Axis::UniformInverseB { .. }) => "1/b",
            RowAxis::Baked(Axis::UniformLogB { .. }) => "ln(b/b_c − 1)",
            RowAxis::ResidualS => "residual against s",
        }
    }

    /// Whether the axis can hold the row of `observer`: a naive axis holds only that of the observer at infinity.
    pub fn serves(self, observer: &Observer) -> bool {
        match self {
            RowAxis::Baked(axis) => axis.is_residual() || observer.is_at_infinity(),
            RowAxis::ResidualS => true,
        }
    }

    /// Position along the row, from 0 to 1; outside this range beyond the ends of the axis.
    pub fn position(self, at: ShadowCoordinate) -> f64 {
        match self {
            RowAxis::Baked(axis) => axis.position(at),
            RowAxis::ResidualS => at.one_minus_x.sqrt(),
        }
    }

    /// The inverse of [`RowAxis::position`].
    pub fn coordinate(self, q: f64) -> ShadowCoordinate {
        match self {
            RowAxis::Baked(axis) => axis.coordinate(q),
            RowAxis::ResidualS => ShadowCoordinate::from_s(q),
        }
    }

    /// Whether q = 0 is the shadow's edge, where the stored value is a limit and cannot be computed.
    pub fn starts_at_shadow_edge(self) -> bool {
        match self {
            RowAxis::Baked(axis) => axis.is_residual(),
            RowAxis::ResidualS => true,
        }
    }

    /// The value that is stored for `bending` at q, and its derivative with respect to q.
    pub fn stored(self, observer: &Observer, q: f64, bending: BendAndSlope) -> Stored {
        match self {
            RowAxis::Baked(axis) => axis.stored(observer, q, bending),
            RowAxis::ResidualS => Stored {
                value: bending.bend + 2.0 * q.ln(),
                slope: -2.0 * q * bending.slope + 2.0 / q,
            },
        }
    }

    /// The bending at `at`, rad, from the stored `value`.
    pub fn bend(self, observer: &Observer, at: ShadowCoordinate, value: f64) -> f64 {
        match self {
            RowAxis::Baked(axis) => axis.bend(observer, at, value),
            RowAxis::ResidualS => value - at.one_minus_x.ln(),
        }
    }
}
