//! The observers that the rows of a table are for.

#[cfg(feature = "files")]
use serde::{Deserialize, Serialize};

/// The observers that the rows are for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize))]
pub enum Rows {
    /// One row, for the observer at rest at 1/r; below the horizon for that of
    /// [`Observer::in_row_frame`](lensbake_core::Observer::in_row_frame).
    One {
        /// 1/r; 0 is the observer at infinity.
        inverse_radius: f64,
    },
    /// Rows uniform in χ, 1/r = sin²χ, from χ = 0 (r = ∞) to π/2 (the horizon), both included.
    Chi {
        /// Number of rows, at least 4.
        count: u32,
    },
    /// Rows as with [`Rows::Chi`], followed by rows uniform in ln(1/r), from the horizon to `r_min`, both included, for
    /// the observers of [`Observer::in_row_frame`](lensbake_core::Observer::in_row_frame).
    ThroughHorizon {
        /// Number of rows above the horizon, at least 4.
        above: u32,
        /// Number of rows below, at least 4.
        below: u32,
        /// Radius of the last row.
        r_min: f64,
    },
}

impl Rows {
    /// Number of rows.
    pub fn count(self) -> u32 {
        match self {
            Rows::One { .. } => 1,
            Rows::Chi { count } => count,
            Rows::ThroughHorizon { above, below, .. } => above.saturating_add(below),
        }
    }
}
