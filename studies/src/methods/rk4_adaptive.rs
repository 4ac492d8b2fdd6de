//! The project's own integrator: RK4 with step doubling, outwards from the periapsis or the photon sphere.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::direct;
use lensbake_core::rk4::Stepper;

/// [`direct::bend`] with adaptive steps.
#[derive(Debug, Clone, Copy)]
pub struct Rk4Adaptive {
    /// Error allowed, rad per radian of orbital angle.
    pub tolerance: f64,
}

impl BendingMethod for Rk4Adaptive {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "RK4 adaptive".to_owned(),
            knobs: format!("tol {:.0e}", self.tolerance),
            source: "this project: lensbake_core::direct",
            family: Family::Direct,
            landmark: self.tolerance == 1e-9,
        }
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        match &initial.ray {
            Ok(ray) => direct::bend(ray, Stepper::Adaptive(self.tolerance)).into(),
            Err(error) => MethodOutcome::Refused(*error),
        }
    }
}
