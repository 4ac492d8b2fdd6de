//! Semi-implicit Euler in φ: what the best-known table of this kind was baked with.

use super::textbook::{Scheme, acceleration, march};
use super::{Card, Family, Launch, Method, Outcome};

/// v += h u″, then u += h v.
#[derive(Debug, Clone, Copy)]
pub struct SemiImplicitEuler {
    /// Step in φ, rad.
    pub h: f64,
}

impl Method for SemiImplicitEuler {
    fn card(&self) -> Card {
        Card {
            name: "semi-implicit Euler".to_owned(),
            knobs: format!("h = {}", self.h),
            source: "Bruneton 2020, arXiv:2010.08735",
            family: Family::Direct,
            landmark: self.h == 0.001,
        }
    }

    fn bend(&self, launch: &Launch) -> Outcome {
        march(launch, self.h, self)
    }
}

impl Scheme<f64> for SemiImplicitEuler {
    fn step(&self, u: f64, v: f64) -> (f64, f64) {
        let v = v + self.h * acceleration(u);
        (u + self.h * v, v)
    }

    /// Where the straight line to the next state meets u = 0.
    fn landing(&self, u: f64, v: f64) -> f64 {
        let (next, _) = self.step(u, v);
        self.h * u / (u - next)
    }
}
