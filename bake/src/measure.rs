//! The error that a table's header states: its lookup against the closed form, off the nodes.

use crate::rays::{Sight, off_nodes};
use lensbake_core::{Observer, exact};
use lensbake_tables::statistics::ErrorStatistics;
use lensbake_tables::{Header, Measured, Row, Table, TableError};
use rayon::prelude::*;

/// Measures `table` and states the error in its header: infinite if any ray meets another fate, or if no
/// ray was measured.
///
/// # Errors
/// [`TableError`] if the table has no row for its own observers, which no valid table lacks.
pub fn measured(table: Table) -> Result<Table, TableError> {
    let sights = off_nodes(table.header());
    let errors = lookup_errors(&table, &sights)?;
    let max_error = ErrorStatistics::of(errors).map_or(f64::INFINITY, |errors| errors.max);
    let radii = sights.iter().map(|s| s.observer.radius());
    let gaps = sights.iter().map(|s| s.at.one_minus_x);
    let header = Header {
        measured: Measured {
            max_error,
            rays: sights.len() as u32,
            r_min: radii.fold(f64::INFINITY, f64::min),
            edge_gap: gaps.fold(1.0, f64::min),
        },
        ..table.header().clone()
    };
    table.with_header(header)
}

/// Lookup minus closed form for each of `sights`, rad, in their order. A fate that differs is NaN.
///
/// # Errors
/// [`TableError::OtherObserver`] if the table holds another observer's row.
pub fn lookup_errors(table: &Table, sights: &[Sight]) -> Result<Vec<f64>, TableError> {
    for_each_sight(table, sights, |row, sight| {
        let looked_up = row.bend(sight.at).escaped().unwrap_or(f64::NAN);
        let closed = exact::bend(&sight.observer.ray_at(sight.at));
        looked_up - closed.escaped().unwrap_or(f64::NAN)
    })
}

/// Calls `f` with each sight and its observer's row, in parallel; a row is mixed once for each run of
/// sights from the same observer.
pub(crate) fn for_each_sight<T: Send>(
    table: &Table,
    sights: &[Sight],
    f: impl Fn(&Row, &Sight) -> T + Sync,
) -> Result<Vec<T>, TableError> {
    let runs: Vec<&[Sight]> = sights.chunk_by(|a, b| a.observer == b.observer).collect();
    let answers: Result<Vec<Vec<T>>, TableError> = runs
        .into_par_iter()
        .map(|run| {
            let observer: Observer = run[0].observer;
            let row = table.row(observer)?;
            Ok(run.iter().map(|sight| f(&row, sight)).collect())
        })
        .collect();
    Ok(answers?.into_iter().flatten().collect())
}
