//! RK4 with fixed steps in φ, started at the observer, in f32 as in shaders or in f64.

use super::textbook::{Scheme, acceleration, march};
use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use num_traits::Float;
use std::marker::PhantomData;

/// RK4 with steps of `h`, in the arithmetic of `T`.
#[derive(Debug, Clone, Copy)]
pub struct Rk4Fixed<T> {
    h: f64,
    arithmetic: PhantomData<T>,
}

impl<T> Rk4Fixed<T> {
    /// The method with steps of `h` rad.
    pub fn new(h: f64) -> Self {
        Rk4Fixed {
            h,
            arithmetic: PhantomData,
        }
    }
}

impl<T: Float + Send + Sync> BendingMethod for Rk4Fixed<T> {
    fn info(&self) -> MethodInfo {
        let bits = 8 * size_of::<T>();
        MethodInfo {
            name: format!("RK4 f{bits}"),
            knobs: format!("h = {}", self.h),
            source: "Kutta 1901",
            family: Family::Direct,
            landmark: self.h == 0.01 || self.h == 0.1,
        }
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        march(initial, self.h, self)
    }
}

impl<T: Float> Scheme<T> for Rk4Fixed<T> {
    fn step(&self, u: T, v: T) -> (T, T) {
        let h = T::from(self.h).unwrap_or_else(T::nan);
        rk4(u, v, h)
    }

    /// One step of RK4 to u = 0 with u as the independent variable (Hénon 1982): dφ/du = 1/v, dv/du = u″/v.
    fn landing(&self, u: T, v: T) -> T {
        let two = T::one() + T::one();
        let (h, half) = (-u, -u / two);
        let dv_du = |u: T, v: T| acceleration(u) / v;
        let v2 = v + half * dv_du(u, v);
        let v3 = v + half * dv_du(u + half, v2);
        let v4 = v + h * dv_du(u + half, v3);
        h / (two + two + two) * (v.recip() + two * (v2.recip() + v3.recip()) + v4.recip())
    }
}

/// One step of RK4 for u′ = v, v′ = u″.
fn rk4<T: Float>(u: T, v: T, h: T) -> (T, T) {
    let f = |u: T, v: T| (v, acceleration(u));
    let two = T::one() + T::one();
    let half = h / two;
    let (a1, b1) = f(u, v);
    let (a2, b2) = f(u + half * a1, v + half * b1);
    let (a3, b3) = f(u + half * a2, v + half * b2);
    let (a4, b4) = f(u + h * a3, v + h * b3);
    let sixth = h / (two + two + two);
    (
        u + sixth * (a1 + two * (a2 + a3) + a4),
        v + sixth * (b1 + two * (b2 + b3) + b4),
    )
}
