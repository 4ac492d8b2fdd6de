//! The Dormand–Prince pair of order 5(4) of the crate `ode_solvers`, started at the observer.

use super::textbook::{LONGEST_PHI, acceleration};
use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use ode_solvers::{Dopri5, OutputType, System, Vector2};

/// Dopri5; the absolute tolerance is a thousandth of the relative one.
#[derive(Debug, Clone, Copy)]
pub struct DormandPrince {
    /// Relative tolerance per step.
    pub tolerance: f64,
}

impl BendingMethod for DormandPrince {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "Dormand–Prince".to_owned(),
            knobs: format!("rtol {:.0e}", self.tolerance),
            source: "Dormand & Prince 1980; crate ode_solvers",
            family: Family::Direct,
            landmark: self.tolerance == 1e-9,
        }
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        let start = Vector2::new(initial.u, initial.du_dphi);
        let Some((phis, states)) = self.integrate(Orbit, 0.0, LONGEST_PHI, start) else {
            return MethodOutcome::Unfinished;
        };
        let [.., before, after] = states.as_slice() else {
            return MethodOutcome::Unfinished;
        };
        if after[0] >= 1.0 {
            return MethodOutcome::Captured;
        }
        if after[0] > 0.0 {
            return MethodOutcome::Unfinished;
        }
        // Restart from the last state before the escape, and integrate to u = 0 with u as the independent
        // variable.
        let last = Vector2::new(phis[phis.len() - 2], before[1]);
        let phi = if before[0] == 0.0 {
            Some(last[0])
        } else {
            self.integrate(Landing, before[0], 0.0, last)
                .and_then(|(_, states)| states.last().map(|state| state[0]))
        };
        phi.map_or(MethodOutcome::Unfinished, |phi| {
            MethodOutcome::Escapes(phi - std::f64::consts::PI + initial.theta)
        })
    }
}

type Solution = (Vec<f64>, Vec<Vector2<f64>>);

impl DormandPrince {
    fn integrate(
        &self,
        system: impl System<f64, Vector2<f64>>,
        from: f64,
        to: f64,
        start: Vector2<f64>,
    ) -> Option<Solution> {
        let (relative, absolute) = (self.tolerance, 1e-3 * self.tolerance);
        let mut solver = Dopri5::new(system, from, to, 0.0, start, relative, absolute);
        solver.set_output(OutputType::Sparse);
        solver.integrate().ok()?;
        Some((solver.x_out().clone(), solver.y_out().clone()))
    }
}

/// (u, v) as a function of φ, with v = du/dφ, until u leaves (0, 1).
struct Orbit;

impl System<f64, Vector2<f64>> for Orbit {
    fn system(&self, _phi: f64, y: &Vector2<f64>, dy: &mut Vector2<f64>) {
        *dy = Vector2::new(y[1], acceleration(y[0]));
    }

    fn solout(&mut self, _phi: f64, y: &Vector2<f64>, _dy: &Vector2<f64>) -> bool {
        !(0.0 < y[0] && y[0] < 1.0)
    }
}

/// (φ, v) as a function of u.
struct Landing;

impl System<f64, Vector2<f64>> for Landing {
    fn system(&self, u: f64, y: &Vector2<f64>, dy: &mut Vector2<f64>) {
        *dy = Vector2::new(1.0 / y[1], acceleration(u) / y[1]);
    }
}
