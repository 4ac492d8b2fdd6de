//! Short integrations of u″ = −u + (3/2) u² from infinity, u = 0 and u′ = 1/b, in a fixed number of steps to the phase.

use super::{Arithmetic, CrossingInfo, Kind, Orbit};
use std::marker::PhantomData;

/// RK4, in the arithmetic of `T`.
#[derive(Debug, Clone, Copy)]
pub struct Rk4<T> {
    steps: u32,
    arithmetic: PhantomData<T>,
}

/// Leapfrog (kick, drift, kick), in the arithmetic of `T`.
#[derive(Debug, Clone, Copy)]
pub struct Leapfrog<T> {
    steps: u32,
    arithmetic: PhantomData<T>,
}

impl<T> Rk4<T> {
    /// With this many steps.
    pub fn new(steps: u32) -> Self {
        Rk4 {
            steps,
            arithmetic: PhantomData,
        }
    }
}

impl<T> Leapfrog<T> {
    /// With this many steps.
    pub fn new(steps: u32) -> Self {
        Leapfrog {
            steps,
            arithmetic: PhantomData,
        }
    }
}

fn info(name: &'static str, source: &'static str, steps: u32) -> CrossingInfo {
    CrossingInfo {
        kind: Kind::Integrated,
        name,
        knobs: format!("{steps} steps"),
        source,
        used: false,
    }
}

fn acceleration<T: Arithmetic>(u: T) -> T {
    u * (T::constant(1.5) * u - T::one())
}

impl<T: Arithmetic> Orbit for Rk4<T> {
    type Number = T;

    fn info(&self) -> CrossingInfo {
        info("RK4", "Kutta 1901", self.steps)
    }

    fn inverse_radius(&self, inv_b: T, phase: T) -> T {
        let c = T::constant;
        let h = phase / c(self.steps.into());
        let (half, sixth) = (c(0.5) * h, c(1.0 / 6.0) * h);
        let (mut u, mut v) = (T::zero(), inv_b);
        for _ in 0..self.steps {
            let a1 = acceleration(u);
            let (v2, a2) = (v + half * a1, acceleration(u + half * v));
            let (v3, a3) = (v + half * a2, acceleration(u + half * v2));
            let (v4, a4) = (v + h * a3, acceleration(u + h * v3));
            u = u + sixth * (v + c(2.0) * (v2 + v3) + v4);
            v = v + sixth * (a1 + c(2.0) * (a2 + a3) + a4);
        }
        u
    }
}

impl<T: Arithmetic> Orbit for Leapfrog<T> {
    type Number = T;

    fn info(&self) -> CrossingInfo {
        info("leapfrog", "Verlet 1967", self.steps)
    }

    fn inverse_radius(&self, inv_b: T, phase: T) -> T {
        let c = T::constant;
        let h = phase / c(self.steps.into());
        let (mut u, mut v) = (T::zero(), inv_b);
        // u″ is 0 at the start, so that the first half kick is none.
        for step in 0..self.steps {
            if step > 0 {
                v = v + h * acceleration(u);
            }
            u = u + h * v;
        }
        u
    }
}
