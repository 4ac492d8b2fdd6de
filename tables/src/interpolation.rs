//! Interpolation between the texels of a row.

use crate::axis::Stored;
use std::ops::{Add, Mul, Sub};

/// Interpolation between two texels. The variants are ordered by cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Interpolation {
    /// Linear. Uses the values only; the error falls as 1/texels².
    Linear,
    /// Cubic Hermite. Uses the values and the slopes of both texels; the error falls as 1/texels⁴.
    Hermite,
}

impl Interpolation {
    /// Name for display.
    pub fn name(self) -> &'static str {
        match self {
            Interpolation::Linear => "linear",
            Interpolation::Hermite => "Hermite",
        }
    }

    /// Name of its function in `lookup.wgsl`.
    pub fn wgsl_function(self) -> &'static str {
        match self {
            Interpolation::Linear => "linear",
            Interpolation::Hermite => "hermite",
        }
    }

    /// Numbers of a texel that it uses: the value, and for Hermite the slope.
    pub fn channels(self) -> usize {
        match self {
            Interpolation::Linear => 1,
            Interpolation::Hermite => 2,
        }
    }

    /// The stored value and its derivative with respect to q at `q` (clamped to [0, 1]). There must be at least
    /// two texels; each is a value and its slope per texel.
    #[inline]
    pub(crate) fn between(self, texels: &[[f64; 2]], q: f64) -> Stored {
        let last = texels.len() - 1;
        let position = q.clamp(0.0, 1.0) * last as f64;
        let i = (position as usize).min(last - 1);
        let t = position - i as f64;
        let [value, slope] = match self {
            Interpolation::Linear => chord(texels[i], texels[i + 1], t),
            Interpolation::Hermite => cubic(texels[i], texels[i + 1], t),
        };
        Stored {
            value,
            slope: slope * last as f64,
        }
    }
}

/// The stored value and its derivative with respect to q at `q` (clamped to [0, 1]), by the polynomial of degree 7
/// through the values and slopes of the four texels around it. There must be at least four texels. It is for the CPU,
/// where a finer row is made from this one: with 64 texels it is hundreds of times as accurate as the cubic where the
/// row is smooth.
pub(crate) fn septic(texels: &[[f64; 2]], q: f64) -> Stored {
    const NODES: usize = 4;
    let last = texels.len() - 1;
    let position = q.clamp(0.0, 1.0) * last as f64;
    let first = (position as usize)
        .saturating_sub(1)
        .min(texels.len() - NODES);
    let t = position - first as f64;
    // Newton's divided differences with each node twice; the difference of equal nodes is the slope.
    let node = |i: usize| (i / 2) as f64;
    let mut differences: [f64; 2 * NODES] = std::array::from_fn(|i| texels[first + i / 2][0]);
    let mut coefficients = [differences[0]; 2 * NODES];
    for (order, coefficient) in coefficients.iter_mut().enumerate().skip(1) {
        for i in 0..2 * NODES - order {
            let width = node(i + order) - node(i);
            differences[i] = if width == 0.0 {
                texels[first + i / 2][1]
            } else {
                (differences[i + 1] - differences[i]) / width
            };
        }
        *coefficient = differences[0];
    }
    let (mut value, mut slope) = (0.0, 0.0);
    for (i, coefficient) in coefficients.iter().enumerate().rev() {
        slope = slope * (t - node(i)) + value;
        value = value * (t - node(i)) + coefficient;
    }
    Stored {
        value,
        slope: slope * last as f64,
    }
}

/// A number type that the interpolations compute with: `f32` as on a GPU, `f64` for the reference.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + From<u8>
{
}

impl Real for f32 {}
impl Real for f64 {}

/// Linear interpolation between the values of the texels `a` (at t = 0) and `b` (at t = 1): the value and its
/// derivative at `t`.
#[inline]
pub fn chord<T: Real>([a, _]: [T; 2], [b, _]: [T; 2], t: T) -> [T; 2] {
    let rise = b - a;
    [a + t * rise, rise]
}

/// Cubic Hermite interpolation between the values and slopes of the texels `a` (at t = 0) and `b` (at t = 1): the
/// value and its derivative at `t`.
#[inline]
pub fn cubic<T: Real>(a: [T; 2], b: [T; 2], t: T) -> [T; 2] {
    horner(cubic_coefficients(a, b), t)
}

/// The coefficients c₀ … c₃ of [`cubic`] as the polynomial c₀ + c₁ t + c₂ t² + c₃ t³.
#[inline]
pub fn cubic_coefficients<T: Real>([a, slope_a]: [T; 2], [b, slope_b]: [T; 2]) -> [T; 4] {
    let (two, three) = (T::from(2), T::from(3));
    let rise = b - a;
    [
        a,
        slope_a,
        three * rise - two * slope_a - slope_b,
        slope_a + slope_b - two * rise,
    ]
}

/// The polynomial c₀ + c₁ t + c₂ t² + c₃ t³ and its derivative at `t`, by Horner's scheme.
#[inline]
pub fn horner<T: Real>([c0, c1, c2, c3]: [T; 4], t: T) -> [T; 2] {
    let (two, three) = (T::from(2), T::from(3));
    [
        c0 + t * (c1 + t * (c2 + t * c3)),
        c1 + t * (two * c2 + t * three * c3),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn septic_reproduces_polynomials_of_degree_seven() {
        let f = |q: f64| 0.3 + q * q * (2.0 - q.powi(5));
        let df = |q: f64| q * (4.0 - 7.0 * q.powi(5));
        let texels: Vec<_> = (0..8)
            .map(|i| f64::from(i) / 7.0)
            .map(|q| [f(q), df(q) / 7.0])
            .collect();
        for i in 0..=100 {
            let q = f64::from(i) / 100.0;
            let stored = septic(&texels, q);
            assert!((stored.value - f(q)).abs() < 1e-12, "{q}");
            assert!((stored.slope - df(q)).abs() < 1e-10, "{q}");
        }
    }

    #[test]
    fn hermite_reproduces_cubics_and_linear_reproduces_lines() {
        let line = |q: f64| [0.5 - 3.0 * q, -3.0];
        let cubic = |q: f64| [1.0 + q * q * (2.0 - 5.0 * q), q * (4.0 - 15.0 * q)];
        for (interpolation, f) in [
            (Interpolation::Linear, &line as &dyn Fn(f64) -> [f64; 2]),
            (Interpolation::Hermite, &cubic),
        ] {
            let texels: Vec<_> = (0..8)
                .map(|i| {
                    let [value, slope] = f(f64::from(i) / 7.0);
                    [value, slope / 7.0]
                })
                .collect();
            for i in 0..=100 {
                let q = f64::from(i) / 100.0;
                let (stored, [value, slope]) = (interpolation.between(&texels, q), f(q));
                assert!(
                    (stored.value - value).abs() < 1e-14,
                    "{interpolation:?} {q}"
                );
                assert!(
                    (stored.slope - slope).abs() < 1e-12,
                    "{interpolation:?} {q}"
                );
            }
        }
    }
}
