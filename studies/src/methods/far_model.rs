//! The observer treated as if at infinity: exact bending for the wrong observer.
//!
//! A camera at o looking along the unit vector d is given the ray from infinity with b = |o × d|, as in bholetrace
//! and other programs. This model is wrong in three ways: it includes the bending between the observer and
//! infinity, which the ray has not undergone; it omits the observer's time dilation, the factor 1/√(1 − 1/r) of b;
//! and it bends a ray from behind the observer as much as one from ahead.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::{Observer, Ray, exact};

/// The closed form Δφ at b = |o × d|, for a static observer at finite radius.
#[derive(Debug, Clone, Copy)]
pub struct FarModel;

impl BendingMethod for FarModel {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "observer put at infinity".to_owned(),
            knobs: "b = |o × d|".to_owned(),
            source: "bholetrace",
            family: Family::Model,
            landmark: true,
        }
    }

    fn serves(&self, observer: &Observer) -> bool {
        !observer.is_at_infinity()
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        let b = initial.theta.sin() / initial.u;
        match Ray::from_infinity(b) {
            Ok(ray) => exact::bend(&ray).into(),
            Err(error) => MethodOutcome::Refused(error),
        }
    }
}
