//! The closed form in elliptic integrals: the project's oracle.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::exact;

/// [`exact::bend`] as a method.
#[derive(Debug, Clone, Copy)]
pub struct ClosedForm;

impl BendingMethod for ClosedForm {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "elliptic integral".to_owned(),
            knobs: String::new(),
            source: "Carlson 1991; this project: lensbake_core::exact",
            family: Family::Closed,
            landmark: true,
        }
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        match &initial.ray {
            Ok(ray) => exact::bend(ray).into(),
            Err(error) => MethodOutcome::Refused(*error),
        }
    }
}
