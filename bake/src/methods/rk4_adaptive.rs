//! The project's own integrator: RK4 with step doubling, from where the ray lingers.

use super::{Card, Family, Launch, Method, Outcome};
use lensbake_core::direct;
use lensbake_core::rk4::Stepper;

/// [`direct::bend`] at a tolerance.
#[derive(Debug, Clone, Copy)]
pub struct Rk4Adaptive {
    /// Error allowed, rad a radian of orbital angle.
    pub tolerance: f64,
}

impl Method for Rk4Adaptive {
    fn card(&self) -> Card {
        Card {
            name: "RK4 adaptive".to_owned(),
            knobs: format!("tol {:.0e}", self.tolerance),
            source: "this project: lensbake_core::direct",
            family: Family::Direct,
            landmark: self.tolerance == 1e-9,
        }
    }

    fn bend(&self, launch: &Launch) -> Outcome {
        match &launch.ray {
            Ok(ray) => direct::bend(ray, Stepper::Adaptive(self.tolerance)).into(),
            Err(error) => Outcome::Refused(*error),
        }
    }
}
