//! Fills a table with the shared RK4 core.

use lensbake_core::rk4::Stepper;
use lensbake_core::{BendAndSlope, EdgeCoordinate, Fate, Observer, direct};
use lensbake_tables::{Axis, Header, Measured, Rows, Solver, Table, TableError, Texel};
use rayon::prelude::*;

/// Name of the solver in the headers.
pub const SOLVER: &str = "RK4 with step doubling";

/// What to bake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recipe {
    /// The axis along the rows.
    pub axis: Axis,
    /// Whose rows.
    pub rows: Rows,
    /// Texels of a row.
    pub texels: u32,
    /// Error allowed, rad a radian of orbital angle.
    pub tolerance: f64,
}

impl Default for Recipe {
    /// The atlas that ships: 128 rows of 64 texels, 64 KiB.
    fn default() -> Self {
        Recipe {
            axis: Axis::Residual,
            rows: Rows::Chi { count: 128 },
            texels: 64,
            tolerance: 1e-9,
        }
    }
}

/// Bakes a table, its rows in parallel; the same bits for any number of threads. `row_done` is called
/// after each row. The header's error is yet to be measured ([`crate::measure`]).
///
/// # Errors
/// [`TableError`] if the recipe's sizes are not a table's, or the solver fails at its tolerance.
pub fn bake(recipe: &Recipe, row_done: impl Fn() + Sync) -> Result<Table, TableError> {
    let header = Header {
        axis: recipe.axis,
        rows: recipe.rows,
        texels: recipe.texels,
        solver: Solver {
            name: SOLVER.to_owned(),
            tolerance: recipe.tolerance,
        },
        measured: Measured::NOTHING,
    };
    header.validate()?;
    let rows: Vec<Vec<Texel>> = (0..header.row_count())
        .into_par_iter()
        .map(|index| {
            let row = bake_row(recipe, &header.observer(index));
            row_done();
            row
        })
        .collect();
    Table::new(header, rows.concat())
}

fn bake_row(recipe: &Recipe, observer: &Observer) -> Vec<Texel> {
    (0..recipe.texels)
        .map(|i| bake_texel(recipe, observer, i))
        .collect()
}

/// The texel at the shadow's edge holds the limit q → 0 of the residual. It is taken at this q, where
/// the residual differs from its limit by about q² = 1e-12.
const EDGE_Q: f64 = 1e-6;

fn bake_texel(recipe: &Recipe, observer: &Observer, index: u32) -> Texel {
    let last = f64::from(recipe.texels - 1);
    let q = f64::from(index) / last;
    let at_edge = recipe.axis == Axis::Residual && index == 0;
    let q = if at_edge { EDGE_Q } else { q };
    let bending = bending(recipe, observer, recipe.axis.coordinate(q));
    let stored = recipe.axis.stored(observer, q, bending);
    let slope = if at_edge { 0.0 } else { stored.slope / last };
    [stored.value as f32, slope as f32]
}

/// The bending by RK4; NaN, which no table takes, for a ray that none of the axes should ask for.
fn bending(recipe: &Recipe, observer: &Observer, at: EdgeCoordinate) -> BendAndSlope {
    match direct::bend_and_slope(observer, at, Stepper::Adaptive(recipe.tolerance)) {
        Fate::Escapes(bending) => bending,
        Fate::Captured => BendAndSlope {
            bend: f64::NAN,
            slope: f64::NAN,
        },
    }
}
