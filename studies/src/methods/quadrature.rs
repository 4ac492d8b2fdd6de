//! Weinberg's integral by Gauss–Legendre quadrature.
//!
//! Δφ = 2 ∫₀^{u_a} du / √(1/b² − u² + u³) − π (Weinberg 1972, eq. 8.5.6) is singular at its upper limit u_a, the
//! periapsis. Let u₁ and u₃ be the other roots of the radicand. The substitution u = u_a (1 − t²), with the factor
//! t cancelled, gives
//!
//! ```text
//! Δφ = 4 √u_a ∫₀¹ dt / √((u − u₁)(u₃ − u)) − π
//! ```
//!
//! with a smooth integrand. Its peak at t = 0 grows as u₃ approaches u_a, which happens as b approaches b_c.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use gauss_quad::GaussLegendre;
use lensbake_core::{B_CRIT, Observer};

/// The integral by a rule with `points` points.
#[derive(Debug, Clone)]
pub struct Quadrature {
    rule: GaussLegendre,
    points: usize,
}

impl Quadrature {
    /// The rule with `points` points; `None` for fewer than 2.
    pub fn new(points: usize) -> Option<Self> {
        let rule = GaussLegendre::new(points).ok()?;
        Some(Quadrature { rule, points })
    }
}

impl BendingMethod for Quadrature {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "Gauss quadrature".to_owned(),
            knobs: format!("{} points", self.points),
            source: "Weinberg 1972, eq. 8.5.6",
            family: Family::Closed,
            landmark: self.points == 16,
        }
    }

    /// The nodes and weights of the rule.
    fn bytes(&self) -> usize {
        2 * self.points * size_of::<f64>()
    }

    fn serves(&self, observer: &Observer) -> bool {
        observer.is_at_infinity()
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        let b = initial.b;
        if b <= B_CRIT {
            return MethodOutcome::Captured;
        }
        let third = (13.5 / (b * b) - 1.0).asin() / 3.0;
        let root = |turn: f64| (1.0 + 2.0 * (third + turn).sin()) / 3.0;
        let turn = 2.0 * std::f64::consts::FRAC_PI_3;
        let (u1, u2, u3) = (root(-turn), root(0.0), root(turn));
        let integral = self.rule.integrate(0.0, 1.0, |t| {
            let u = u2 * (1.0 - t * t);
            1.0 / ((u - u1) * (u3 - u)).sqrt()
        });
        MethodOutcome::Escapes(4.0 * u2.sqrt() * integral - std::f64::consts::PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_converges_to_the_known_value() {
        let error = |points| {
            let bend = Quadrature::new(points)
                .unwrap()
                .bend(&InitialConditions::from_infinity(3.0))
                .bend();
            (bend.unwrap() - 1.719_388_310_230_169).abs()
        };
        assert!(error(8) > 1e-9, "{:e}", error(8));
        assert!(error(64) < 1e-13, "{:e}", error(64));
    }
}
