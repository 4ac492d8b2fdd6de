//! Semi-implicit Euler in φ, with which the best-known table of this kind was baked (Bruneton 2020).

use super::textbook::{Scheme, acceleration, march};
use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};

/// v += h u″, then u += h v.
#[derive(Debug, Clone, Copy)]
pub struct SemiImplicitEuler {
    /// Step in φ, rad.
    pub h: f64,
}

impl BendingMethod for SemiImplicitEuler {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "semi-implicit Euler".to_owned(),
            knobs: format!("h = {}", self.h),
            source: "Bruneton 2020, arXiv:2010.08735",
            family: Family::Direct,
            landmark: self.h == 0.001,
        }
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        march(initial, self.h, self)
    }
}

impl Scheme<f64> for SemiImplicitEuler {
    fn step(&self, u: f64, v: f64) -> (f64, f64) {
        let v = v + self.h * acceleration(u);
        (u + self.h * v, v)
    }

    /// The φ interval to u = 0 along the straight line to the next state, rad.
    fn landing(&self, u: f64, v: f64) -> f64 {
        let (next, _) = self.step(u, v);
        self.h * u / (u - next)
    }
}
