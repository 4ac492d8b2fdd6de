//! The axes of the tables under comparison: the shipped one, the naive ones, and the plain residual.

use lensbake_core::{BendAndSlope, EdgeCoordinate, Observer};
use lensbake_tables::{Axis, Stored};

/// What a table's texels are spread along, and what they hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowAxis {
    /// One of those that `bake` bakes.
    Baked(Axis),
    /// s = √(1−x), holding R = Δ + 2 ln s: the leading logarithm alone is taken away.
    ResidualS,
}

impl RowAxis {
    /// Its name in the CSV files and figures.
    pub fn name(self) -> &'static str {
        match self {
            RowAxis::Baked(Axis::Residual) => "the residual",
            RowAxis::Baked(Axis::UniformB { .. }) => "b",
            RowAxis::Baked(Axis::UniformInverseB { .. }) => "1/b",
            RowAxis::Baked(Axis::UniformLogB { .. }) => "ln(b/b_c − 1)",
            RowAxis::ResidualS => "residual against s",
        }
    }

    /// Whether it can hold the row of `observer`: the naive axes hold the far one only.
    pub fn serves(self, observer: &Observer) -> bool {
        match self {
            RowAxis::Baked(axis) => axis == Axis::Residual || observer.is_far(),
            RowAxis::ResidualS => true,
        }
    }

    /// Position from 0 to 1 along the row; beyond it where the axis does not reach.
    pub fn position(self, at: EdgeCoordinate) -> f64 {
        match self {
            RowAxis::Baked(axis) => axis.position(at),
            RowAxis::ResidualS => at.one_minus_x.sqrt(),
        }
    }

    /// The inverse of [`RowAxis::position`].
    pub fn coordinate(self, q: f64) -> EdgeCoordinate {
        match self {
            RowAxis::Baked(axis) => axis.coordinate(q),
            RowAxis::ResidualS => EdgeCoordinate::from_s(q),
        }
    }

    /// Whether the value at q = 0 is a limit, which cannot be computed there.
    pub fn begins_at_the_edge(self) -> bool {
        matches!(self, RowAxis::Baked(Axis::Residual) | RowAxis::ResidualS)
    }

    /// What the texels hold of a bending at q, with its derivative by q.
    pub fn stored(self, observer: &Observer, q: f64, bending: BendAndSlope) -> Stored {
        match self {
            RowAxis::Baked(axis) => axis.stored(observer, q, bending),
            RowAxis::ResidualS => Stored {
                value: bending.bend + 2.0 * q.ln(),
                slope: -2.0 * q * bending.slope + 2.0 / q,
            },
        }
    }

    /// The bending at `at` from what the texels hold, rad.
    pub fn bend(self, observer: &Observer, at: EdgeCoordinate, value: f64) -> f64 {
        match self {
            RowAxis::Baked(axis) => axis.bend(observer, at, value),
            RowAxis::ResidualS => value - at.one_minus_x.ln(),
        }
    }
}
