//! The march that textbooks give: straight from the launch, u and du/dφ in steps of φ, until u passes
//! 0 (the sky) or 1 (the horizon).

use super::{Launch, Outcome};
use num_traits::Float;

/// No ray that f64 tells from a captured one turns by more, rad.
pub const LONGEST_PHI: f64 = 100.0;

/// One step, and where between two steps u = 0 lies.
pub trait Scheme<T> {
    /// (u, du/dφ) one step on.
    fn step(&self, u: T, v: T) -> (T, T);
    /// The φ from the state (u, v), the last with u > 0, to u = 0.
    fn landing(&self, u: T, v: T) -> T;
}

/// u″ = −u + (3/2) u².
pub fn acceleration<T: Float>(u: T) -> T {
    let three_halves = T::one() + T::one() / (T::one() + T::one());
    u * (three_halves * u - T::one())
}

/// Marches `launch` in steps of `h` (rad) with all arithmetic in `T`.
pub fn march<T: Float>(launch: &Launch, h: f64, scheme: &impl Scheme<T>) -> Outcome {
    let real = |value: f64| T::from(value).unwrap_or_else(T::nan);
    let (mut u, mut v) = (real(launch.u), real(launch.du_dphi));
    let step = real(h);
    for n in 0..(LONGEST_PHI / h) as u32 {
        let (next_u, next_v) = scheme.step(u, v);
        if next_u <= T::zero() {
            let phi = real(f64::from(n)) * step + scheme.landing(u, v);
            let bend = phi - real(std::f64::consts::PI) + real(launch.theta);
            return Outcome::Escapes(bend.to_f64().unwrap_or(f64::NAN));
        }
        if next_u >= T::one() {
            return Outcome::Captured;
        }
        if next_u.is_nan() {
            return Outcome::Escapes(f64::NAN);
        }
        (u, v) = (next_u, next_v);
    }
    Outcome::Unfinished
}
