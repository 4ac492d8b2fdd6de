//! The stability atlas: every method in every regime, each answer compared with the closed form to 60 digits.

mod columns;
pub mod csv;
pub mod figure;
mod in_motion;
mod promise;
mod regime;
mod trial;
mod verdict;

pub use columns::is_product;
pub use in_motion::{Direction, InMotion};
pub use promise::promise;
pub use regime::{Input, Regime, Truth, regimes};
pub use trial::Trial;
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
    let Trial {
        observer,
        initial,
        aberration,
    } = regime.input.trial();
    let verdict = |method: &dyn BendingMethod| {
        // The other methods are for observers above the horizon: they end at u = 1.
        let is_for_it = !observer.is_inside() || is_product(&method.info());
        if !is_for_it || !method.serves(&observer) {
            return Verdict::NotServed;
        }
        let outcome = match method.bend(&initial) {
            MethodOutcome::Escapes(bend) => MethodOutcome::Escapes(bend + aberration),
            other => other,
        };
        Verdict::of(outcome, regime.truth)
    };
    let methods = columns::for_observer(observer)?;
    Ok(methods
        .iter()
        .map(|method| verdict(method.as_ref()))
        .collect())
}

impl Atlas {
    /// The regimes of observers at rest, or those of observers in motion, with the methods that serve any of them.
    pub fn part(&self, in_motion: bool) -> Atlas {
        let lines = self.lines.iter();
        let lines: Vec<&Line> = lines
            .filter(|line| line.regime.is_in_motion() == in_motion)
            .collect();
        let serves = |column: &usize| {
            let mut verdicts = lines.iter().map(|line| line.verdicts[*column]);
            verdicts.any(|verdict| verdict != Verdict::NotServed)
        };
        let columns: Vec<usize> = (0..self.columns.len()).filter(serves).collect();
        let verdicts = |line: &Line| {
            columns
                .iter()
                .map(|&column| line.verdicts[column])
                .collect()
        };
        Atlas {
            columns: columns
                .iter()
                .map(|&column| self.columns[column].clone())
                .collect(),
            lines: lines
                .iter()
                .map(|line| Line {
                    regime: line.regime.clone(),
                    verdicts: verdicts(line),
                })
                .collect(),
        }
    }

    /// The cells in which one of the product's own methods fails: it is not right, or it answers although the
    /// input is not a ray. Below the horizon the table may be off by as much as it promises ([`promise()`]).
    pub fn product_failures(&self) -> Vec<(&Regime, &MethodInfo, Verdict)> {
        let cells = self.lines.iter().flat_map(|line| {
            let columns = self.columns.iter().zip(&line.verdicts);
            columns.map(move |(info, &verdict)| (&line.regime, info, verdict))
        });
        let keeps_promise = |regime: &Regime, info: &MethodInfo, verdict: Verdict| match verdict {
            Verdict::Off(error) => error <= promise(info, &regime.input.trial().observer),
            other => other.is_good(),
        };
        cells
            .filter(|&(regime, info, verdict)| {
                is_product(info) && !keeps_promise(regime, info, verdict)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_core::{CoreError, MovingFrame, RayOutcome, exact};
    use std::sync::LazyLock;

    static ATLAS: LazyLock<Atlas> = LazyLock::new(|| atlas(|| ()).unwrap());

    /// Error that the rounding of the input of an observer in motion may cause, rad: of the view angle after a boost,
    /// which near the shadow's edge costs 1/(1−x) times as much, and of x below the horizon, where the ray depends on
    /// (1−x) |C|.
    fn rounding(input: Input) -> f64 {
        let Input::InMotion(InMotion { r, motion, .. }) = input else {
            return 0.0;
        };
        let Trial {
            observer, initial, ..
        } = input.trial();
        let is_boosted = MovingFrame::new(r, motion).is_ok_and(|frame| frame.boost().is_some());
        let boost = if is_boosted {
            1e-15 / initial.at.one_minus_x
        } else {
            0.0
        };
        boost + f64::EPSILON * observer.cos_shadow_at_rest().abs()
    }

    /// Checks a bending in closed form against the truth.
    pub(super) fn check(regime: &Regime, bend: Result<RayOutcome, CoreError>) {
        match (bend, regime.truth) {
            (Ok(RayOutcome::Escapes(bend)), Truth::Escapes(truth)) => {
                let error = (bend - truth).abs();
                let allowed = 3e-14 * (1.0 + truth.abs()) + rounding(regime.input);
                assert!(error < allowed, "{}: {error:e}", regime.title());
            }
            (Ok(RayOutcome::Captured), Truth::Captured) | (Err(_), Truth::NoRay) => (),
            (bend, truth) => panic!("{}: {bend:?} for {truth:?}", regime.title()),
        }
    }

    #[test]
    fn the_oracle_agrees_with_the_closed_form_in_60_digits() {
        for regime in regimes() {
            let trial = regime.input.trial();
            let bend = trial.initial.ray.map(|ray| exact::bend(&ray));
            check(
                &regime,
                bend.map(|bend| bend.map(|bend| bend + trial.aberration)),
            );
        }
        let rays = regimes()
            .into_iter()
            .filter(|regime| regime.truth != Truth::NoRay);
        assert!(rays.count() >= 130);
    }

    #[test]
    fn the_product_is_right_or_refuses_everywhere() {
        let failures = ATLAS.product_failures();
        assert!(failures.is_empty(), "{failures:#?}");
    }

    #[test]
    fn the_atlas_is_large_enough_and_every_cell_is_as_it_was() {
        let atlas = &*ATLAS;
        assert!(atlas.columns.len() >= 12 && atlas.lines.len() >= 150);
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

    #[test]
    fn the_parts_hold_all_regimes_and_only_columns_that_serve_them() {
        let parts = [false, true].map(|in_motion| ATLAS.part(in_motion));
        let lines: Vec<&Line> = parts.iter().flat_map(|part| &part.lines).collect();
        assert_eq!(lines.len(), ATLAS.lines.len());
        assert_eq!(parts[0].columns, ATLAS.columns);
        let names: Vec<&str> = parts[1]
            .columns
            .iter()
            .map(|info| info.name.as_str())
            .collect();
        assert!(names.contains(&"leapfrog, Cartesian") && !names.contains(&"weak series"));
        assert!(
            parts[1]
                .lines
                .iter()
                .all(|line| line.verdicts.len() == names.len())
        );
    }

    /// The table's error below the horizon is shown, not called right.
    #[test]
    fn only_the_table_and_only_below_the_horizon_is_off_by_its_promise() {
        let mut off = 0;
        for line in &ATLAS.lines {
            for (info, verdict) in ATLAS.columns.iter().zip(&line.verdicts) {
                if let (true, Verdict::Off(error)) = (is_product(info), verdict) {
                    assert_eq!(info.name, "lensbake default row");
                    assert!(line.regime.input.trial().observer.radius() < 1.0);
                    assert!(*error > TOLERANCE);
                    off += 1;
                }
            }
        }
        assert!(off > 0);
    }
}
