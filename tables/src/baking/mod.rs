//! Computes a table with the RK4 integrator, and measures its error against the closed form.

mod measure;
mod rays;
mod rays_in_motion;

pub use measure::{for_each_ray, lookup_errors, measured};
pub use rays::{EDGE_GAP, ObservedRay, R_MIN, off_nodes, random};
pub use rays_in_motion::{FrameRay, random_in_motion};

use crate::{Axis, Header, Measured, Rows, Solver, Table, TableError, Texel};
use lensbake_core::rk4::Stepper;
use lensbake_core::{BendAndSlope, Observer, RayOutcome, ShadowCoordinate, direct};
use rayon::prelude::*;

/// Name of the solver in the header.
pub const SOLVER: &str = "RK4 with step doubling";

/// The parameters of a table to bake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recipe {
    /// The axis along a row.
    pub axis: Axis,
    /// The observers that the rows are for.
    pub rows: Rows,
    /// Number of texels per row.
    pub texels: u32,
    /// Error allowed, rad per radian of orbital angle.
    pub tolerance: f64,
}

impl Default for Recipe {
    /// The default atlas: 128 rows above the horizon and 64 below, of 64 texels: 96 KiB.
    fn default() -> Self {
        Recipe {
            axis: Axis::Residual,
            rows: Rows::ThroughHorizon {
                above: 128,
                below: 64,
                r_min: 0.01,
            },
            texels: 64,
            tolerance: 1e-9,
        }
    }
}

/// Bakes a table, its rows in parallel; the result is the same to the bit for any number of threads. `row_done` is
/// called after each row. The header's error is still to be measured ([`measured`]).
///
/// # Errors
/// [`TableError`] if the sizes in the recipe are not valid for a table, or the solver fails at its tolerance.
///
/// ```
/// use lensbake_tables::Rows;
/// use lensbake_tables::baking::{Recipe, bake, measured};
///
/// # fn main() -> Result<(), lensbake_tables::TableError> {
/// let recipe = Recipe {
///     rows: Rows::One { inverse_radius: 0.1 },
///     ..Recipe::default()
/// };
/// let table = measured(bake(&recipe, || ())?)?;
/// assert!(table.header().measured.max_error < 1e-7);
/// # Ok(())
/// # }
/// ```
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
        measured_below: None,
    };
    header.validate()?;
    let rows: Vec<Vec<Texel>> = (0..header.row_count())
        .into_par_iter()
        .map(|index| {
            let row = bake_row(recipe, header.axis_of_row(index), &header.observer(index));
            row_done();
            row
        })
        .collect();
    Table::new(header, rows.concat())
}

fn bake_row(recipe: &Recipe, axis: Axis, observer: &Observer) -> Vec<Texel> {
    (0..recipe.texels)
        .map(|i| bake_texel(recipe, axis, observer, i))
        .collect()
}

/// The texel at the shadow boundary holds the limit of the residual for q → 0. It is computed at this q, where the
/// residual differs from its limit by about q² = 1e-12.
const EDGE_Q: f64 = 1e-6;

fn bake_texel(recipe: &Recipe, axis: Axis, observer: &Observer, index: u32) -> Texel {
    let last = f64::from(recipe.texels - 1);
    let q = f64::from(index) / last;
    let at_edge = axis.is_residual() && index == 0;
    let q = if at_edge { EDGE_Q } else { q };
    let bending = bending(recipe, observer, axis.shadow_coordinate(observer, q));
    let stored = axis.stored(observer, q, bending);
    let slope = if at_edge { 0.0 } else { stored.slope / last };
    [stored.value as f32, slope as f32]
}

/// The bending by RK4. NaN, which a table refuses, for a captured ray; no axis should ask for one.
fn bending(recipe: &Recipe, observer: &Observer, at: ShadowCoordinate) -> BendAndSlope {
    match direct::bend_and_slope(observer, at, Stepper::Adaptive(recipe.tolerance)) {
        RayOutcome::Escapes(bending) => bending,
        RayOutcome::Captured => BendAndSlope {
            bend: f64::NAN,
            slope: f64::NAN,
        },
    }
}
