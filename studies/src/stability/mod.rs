//! The stability atlas: every method in every regime, each answer compared with the closed form to 60 digits.

mod columns;
pub mod csv;
pub mod figure;
mod regime;
mod verdict;

pub use columns::is_product;
pub use regime::{Input, Regime, Truth, regimes};
pub use verdict::{TOLERANCE, Verdict};

use crate::methods::{BendingMethod, MethodInfo, MethodOutcome};
use lensbake_tables::TableError;
use rayon::prelude::*;

/// One regime and the verdict on each method.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The regime.
    pub regime: Regime,
    /// One verdict per column, in the order of the columns.
    pub verdicts: Vec<Verdict>,
}

/// The verdicts on all methods in all regimes.
#[derive(Debug, Clone, PartialEq)]
pub struct Atlas {
    /// The methods, the product's own first.
    pub columns: Vec<MethodInfo>,
    /// The regimes, in the order of `regimes.csv`.
    pub lines: Vec<Line>,
}

/// Tries every method in every regime. `line_done` is called after each regime.
///
/// # Errors
/// [`TableError`] if the shipped atlas has no row for an observer; it has one for every observer.
pub fn atlas(line_done: impl Fn() + Sync) -> Result<Atlas, TableError> {
    let lines: Result<Vec<Line>, TableError> = regimes()
        .into_par_iter()
        .map(|regime| {
            let verdicts = judge(&regime)?;
            line_done();
            Ok(Line { regime, verdicts })
        })
        .collect();
    let columns = columns::for_observer(lensbake_core::Observer::at_infinity())?;
    Ok(Atlas {
        columns: columns.iter().map(|method| method.info()).collect(),
        lines: lines?,
    })
}

fn judge(regime: &Regime) -> Result<Vec<Verdict>, TableError> {
    let observer = regime.input.observer();
    let initial = regime.input.initial();
    let verdict = |method: &dyn BendingMethod| {
        if !method.serves(&observer) {
            return Verdict::NotServed;
        }
        let outcome: MethodOutcome = method.bend(&initial);
        Verdict::of(outcome, regime.truth)
    };
    let methods = columns::for_observer(observer)?;
    Ok(methods
        .iter()
        .map(|method| verdict(method.as_ref()))
        .collect())
}

impl Atlas {
    /// The cells in which one of the product's own methods fails: it is not right, or it answers although the
    /// input is not a ray.
    pub fn product_failures(&self) -> Vec<(&Regime, &MethodInfo, Verdict)> {
        let cells = self.lines.iter().flat_map(|line| {
            let columns = self.columns.iter().zip(&line.verdicts);
            columns.map(move |(info, &verdict)| (&line.regime, info, verdict))
        });
        cells
            .filter(|(_, info, verdict)| is_product(info) && !verdict.is_good())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::InitialConditions;
    use lensbake_core::{RayOutcome, exact};
    use std::sync::LazyLock;

    static ATLAS: LazyLock<Atlas> = LazyLock::new(|| atlas(|| ()).unwrap());

    #[test]
    fn the_oracle_agrees_with_the_closed_form_in_60_digits() {
        let mut compared = 0;
        for regime in regimes() {
            let InitialConditions { ray: Ok(ray), .. } = regime.input.initial() else {
                assert_eq!(regime.truth, Truth::NoRay, "{}", regime.name);
                continue;
            };
            match (exact::bend(&ray), regime.truth) {
                (RayOutcome::Escapes(bend), Truth::Escapes(truth)) => {
                    let error = (bend - truth).abs();
                    assert!(error < 3e-14 * (1.0 + truth), "{}: {error:e}", regime.name);
                }
                (RayOutcome::Captured, Truth::Captured) => (),
                (bend, truth) => panic!("{}: {bend:?} for {truth:?}", regime.name),
            }
            compared += 1;
        }
        assert!(compared >= 45, "{compared}");
    }

    #[test]
    fn the_product_is_right_or_refuses_everywhere() {
        let failures = ATLAS.product_failures();
        assert!(failures.is_empty(), "{failures:#?}");
    }

    #[test]
    fn the_atlas_is_large_enough_and_every_cell_is_as_it_was() {
        let atlas = &*ATLAS;
        assert!(atlas.columns.len() >= 12 && atlas.lines.len() >= 25);
        let recorded = csv::read(include_str!("../../../docs/stability/atlas.csv")).unwrap();
        let mut compared = 0;
        for line in &atlas.lines {
            for (info, verdict) in atlas.columns.iter().zip(&line.verdicts) {
                let key = (line.regime.title(), info.label());
                let known = recorded.get(&key);
                let known = known.unwrap_or_else(|| panic!("{key:?} is not recorded"));
                assert!(verdict.agrees_with(known), "{key:?}: {verdict} was {known}");
                compared += 1;
            }
        }
        assert_eq!(compared, recorded.len());
    }
}
