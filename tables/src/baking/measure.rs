//! The error that a table's header states: its lookup compared with the closed form, between the nodes of the
//! table.

use super::rays::{ObservedRay, off_nodes};
use crate::statistics::ErrorStatistics;
use crate::{Header, Measured, Row, Table, TableError};
use lensbake_core::exact;
use rayon::prelude::*;

/// Measures the error of `table` and writes it into the header, below the horizon separately. The error is infinite if
/// the outcome of any ray differs from the closed form's, or if no ray was measured.
///
/// # Errors
/// [`TableError`] if the table has no row for its own observers, which does not happen with a valid table.
pub fn measured(table: Table) -> Result<Table, TableError> {
    let (below, above): (Vec<_>, Vec<_>) = off_nodes(table.header())
        .into_iter()
        .partition(|ray| ray.observer.is_inside());
    let has_both = !below.is_empty() && !above.is_empty();
    let first = if above.is_empty() { &below } else { &above };
    let header = Header {
        measured: measure(&table, first)?,
        measured_below: has_both.then(|| measure(&table, &below)).transpose()?,
        ..table.header().clone()
    };
    table.with_header(header)
}

fn measure(table: &Table, rays: &[ObservedRay]) -> Result<Measured, TableError> {
    let errors = lookup_errors(table, rays)?;
    let radii = rays.iter().map(|s| s.observer.radius());
    let gaps = rays.iter().map(|s| s.at.one_minus_x);
    Ok(Measured {
        max_error: ErrorStatistics::of(errors).map_or(f64::INFINITY, |errors| errors.max),
        rays: rays.len() as u32,
        r_min: radii.fold(f64::INFINITY, f64::min),
        edge_gap: gaps.fold(1.0, f64::min),
    })
}

/// Lookup minus closed form for each ray of `rays`, rad, in the same order. NaN for a ray that either of them
/// captures.
///
/// # Errors
/// As [`for_each_ray`].
pub fn lookup_errors(table: &Table, rays: &[ObservedRay]) -> Result<Vec<f64>, TableError> {
    for_each_ray(table, rays, |row, ray| {
        let looked_up = row
            .bend_for(&ray.observer, ray.at)
            .escaped()
            .unwrap_or(f64::NAN);
        let closed = exact::bend(&ray.observer.ray_at(ray.at));
        looked_up - closed.escaped().unwrap_or(f64::NAN)
    })
}

/// Calls `f` with each ray of `rays` and the row of its observer's row frame ([`in_row_frame`]), in parallel.
/// The row is interpolated once for each run of consecutive rays with the same observer.
///
/// # Errors
/// [`TableError::OtherObserver`] if the table holds only the row of another observer,
/// [`TableError::NoRowsBelow`] if it does not reach down to an observer.
///
/// [`in_row_frame`]: lensbake_core::Observer::in_row_frame
pub fn for_each_ray<R: AsRef<ObservedRay> + Sync, T: Send>(
    table: &Table,
    rays: &[R],
    f: impl Fn(&Row, &R) -> T + Sync,
) -> Result<Vec<T>, TableError> {
    let observer = |ray: &R| ray.as_ref().observer;
    let runs: Vec<&[R]> = rays.chunk_by(|a, b| observer(a) == observer(b)).collect();
    let answers: Result<Vec<Vec<T>>, TableError> = runs
        .into_par_iter()
        .map(|run| {
            let row = table.row(observer(&run[0]).in_row_frame())?;
            Ok(run.iter().map(|ray| f(&row, ray)).collect())
        })
        .collect();
    Ok(answers?.into_iter().flatten().collect())
}
