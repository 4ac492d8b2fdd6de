//! How a lookup reads between two texels.

use crate::axis::Stored;

/// How a lookup reads between two texels. Ordered by what it costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Interpolation {
    /// Along the chord. Reads the values only; the error falls as 1/texels².
    Linear,
    /// Along the cubic that has the values and the slopes of both. The error falls as 1/texels⁴.
    Hermite,
}

impl Interpolation {
    /// Its name as programs print it.
    pub fn name(self) -> &'static str {
        match self {
            Interpolation::Linear => "linear",
            Interpolation::Hermite => "Hermite",
        }
    }

    /// The function of `lookup.wgsl` that does it.
    pub fn wgsl_function(self) -> &'static str {
        match self {
            Interpolation::Linear => "linear",
            Interpolation::Hermite => "hermite",
        }
    }

    /// Bytes of a texel on the GPU: the value, and the slope where it is read.
    pub fn texel_bytes(self) -> usize {
        match self {
            Interpolation::Linear => size_of::<f32>(),
            Interpolation::Hermite => size_of::<[f32; 2]>(),
        }
    }

    /// The stored value and its derivative by q at `q` (clamped to 0 … 1), from at least two texels
    /// of value and slope a texel.
    #[inline]
    pub(crate) fn between(self, texels: &[[f64; 2]], q: f64) -> Stored {
        let last = texels.len() - 1;
        let position = q.clamp(0.0, 1.0) * last as f64;
        let i = (position as usize).min(last - 1);
        let t = position - i as f64;
        let ([a, slope_a], [b, slope_b]) = (texels[i], texels[i + 1]);
        let rise = b - a;
        let (value, slope) = match self {
            Interpolation::Linear => (a + t * rise, rise),
            Interpolation::Hermite => {
                let c2 = 3.0 * rise - 2.0 * slope_a - slope_b;
                let c3 = slope_a + slope_b - 2.0 * rise;
                (
                    a + t * (slope_a + t * (c2 + t * c3)),
                    slope_a + t * (2.0 * c2 + t * 3.0 * c3),
                )
            }
        };
        Stored {
            value,
            slope: slope * last as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
