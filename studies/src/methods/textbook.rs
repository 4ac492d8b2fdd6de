//! The integration of textbooks: from the observer, u and du/dφ advance in steps of φ until u passes 0 (the sky)
//! or 1 (the horizon).

use super::{InitialConditions, MethodOutcome};
use num_traits::Float;

/// Upper bound of φ, rad. An escaping ray that f64 can distinguish from a captured one turns by less.
pub const LONGEST_PHI: f64 = 100.0;

/// A one-step scheme, and its solution for u = 0 between two steps.
pub trait Scheme<T> {
    /// (u, du/dφ) after one step.
    fn step(&self, u: T, v: T) -> (T, T);
    /// The φ interval from the state (u, v), the last one with u > 0, to u = 0.
    fn landing(&self, u: T, v: T) -> T;
}

/// The right-hand side of the Binet equation, u″ = −u + (3/2) u².
pub fn acceleration<T: Float>(u: T) -> T {
    let three_halves = T::one() + T::one() / (T::one() + T::one());
    u * (three_halves * u - T::one())
}

/// Integrates from `initial` in steps of `h` (rad), with all arithmetic in `T`.
pub fn march<T: Float>(
    initial: &InitialConditions,
    h: f64,
    scheme: &impl Scheme<T>,
) -> MethodOutcome {
    let real = |value: f64| T::from(value).unwrap_or_else(T::nan);
    let (mut u, mut v) = (real(initial.u), real(initial.du_dphi));
    let step = real(h);
    for n in 0..(LONGEST_PHI / h) as u32 {
        let (next_u, next_v) = scheme.step(u, v);
        if next_u <= T::zero() {
            let phi = real(f64::from(n)) * step + scheme.landing(u, v);
            let bend = phi - real(std::f64::consts::PI) + real(initial.theta);
            return MethodOutcome::Escapes(bend.to_f64().unwrap_or(f64::NAN));
        }
        if next_u >= T::one() {
            return MethodOutcome::Captured;
        }
        if next_u.is_nan() {
            return MethodOutcome::Escapes(f64::NAN);
        }
        (u, v) = (next_u, next_v);
    }
    MethodOutcome::Unfinished
}
