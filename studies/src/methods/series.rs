//! The weak-field and the strong-deflection limit, each applied at every b.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::{B_CRIT, Observer, series};

/// The weak-field series: four terms in 1/b.
#[derive(Debug, Clone, Copy)]
pub struct WeakSeries;

impl BendingMethod for WeakSeries {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "weak series".to_owned(),
            knobs: "4 terms".to_owned(),
            source: "Keeton & Petters 2005",
            family: Family::Closed,
            landmark: true,
        }
    }

    fn serves(&self, observer: &Observer) -> bool {
        observer.is_at_infinity()
    }

    /// The series has no captured rays, so the shadow is added explicitly.
    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        if initial.b <= B_CRIT {
            return MethodOutcome::Captured;
        }
        MethodOutcome::Escapes(series::weak(initial.b))
    }
}

/// The strong-deflection limit: the logarithm near the critical impact parameter b_c.
#[derive(Debug, Clone, Copy)]
pub struct StrongLimit;

impl BendingMethod for StrongLimit {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "strong limit".to_owned(),
            knobs: String::new(),
            source: "Bozza 2002",
            family: Family::Closed,
            landmark: true,
        }
    }

    fn serves(&self, observer: &Observer) -> bool {
        observer.is_at_infinity()
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        if initial.b <= B_CRIT {
            return MethodOutcome::Captured;
        }
        MethodOutcome::Escapes(series::strong(initial.b))
    }
}
