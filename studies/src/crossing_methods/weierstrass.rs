//! The closed form in Weierstrass' ℘ by its Laurent series and duplications, as in [`lensbake_core::orbit`], for any
//! arithmetic and any number of duplications.

use super::{Arithmetic, CrossingInfo, Kind, Orbit};
use std::marker::PhantomData;

/// The closed form with this many duplications, in the arithmetic of `T`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Weierstrass<T, const DUPLICATIONS: i32>(PhantomData<T>);

/// Duplications of the renderer's shader, which computes in f32.
pub const USED_IN_F32: i32 = 1;
/// Duplications of [`lensbake_core::orbit`].
pub const USED_IN_F64: i32 = 3;

impl<T: Arithmetic, const DUPLICATIONS: i32> Orbit for Weierstrass<T, DUPLICATIONS> {
    type Number = T;

    fn info(&self) -> CrossingInfo {
        let used = if T::bits() == 32 {
            USED_IN_F32
        } else {
            USED_IN_F64
        };
        CrossingInfo {
            kind: Kind::Weierstrass,
            name: "Weierstrass",
            knobs: match DUPLICATIONS {
                1 => "1 duplication".to_owned(),
                n => format!("{n} duplications"),
            },
            source: "this project: lensbake_core::orbit",
            used: DUPLICATIONS == used,
        }
    }

    fn inverse_radius(&self, inv_b: T, phase: T) -> T {
        let c = T::constant;
        let (sigma, phase_sq) = (inv_b * phase, phase * phase);
        let scale = c(0.25f64.powi(DUPLICATIONS));
        let w = phase_sq * scale;
        let mut g2 = w * w * c(1.0 / 12.0);
        let mut g3 = w * w * (w * c(1.0 / 216.0) - sigma * sigma * (scale * c(1.0 / 16.0)));
        let mut p = T::one()
            + g2 * c(1.0 / 20.0)
            + g3 * c(1.0 / 28.0)
            + g2 * (g2 * c(1.0 / 1200.0) + g3 * c(3.0 / 6160.0));
        for _ in 0..DUPLICATIONS {
            let square = p * p + c(0.25) * g2;
            let numerator = square * square + c(2.0) * g3 * p;
            p = numerator / (p * (p * p - c(0.25) * g2) - c(0.25) * g3);
            g2 = g2 * c(16.0);
            g3 = g3 * c(64.0);
        }
        let above_pole = p + phase_sq * c(1.0 / 12.0);
        let minus_derivative = (p * (c(4.0) * p * p - g2) - g3).max(T::zero()).sqrt();
        sigma * (minus_derivative + c(0.25) * sigma * phase_sq) / (c(2.0) * above_pole * above_pole)
    }
}
