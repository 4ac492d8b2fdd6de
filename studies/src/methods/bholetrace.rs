//! The search for the closest approach (periapsis) r₀ in bholetrace, a 2022 program that this project started
//! from: RK4 in φ from infinity; whenever u falls, the step is halved and reversed. The bending is
//! Δφ = 2 φ(r₀) − π.
//!
//! Its report states u″ = −u + (3/2) u². Its shader writes 3/2 in integers, which is 1.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::Observer;

/// The equation that the search integrates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BholetraceEquation {
    /// u″ = −u + (3/2) u².
    Report,
    /// u″ = −u + u².
    Shader,
}

/// The search as published: first step 0.5, at least 30 steps, at most 100, finished when φ changes by less than
/// 1e-8.
#[derive(Debug, Clone, Copy)]
pub struct BholetraceSearch {
    /// The equation.
    pub equation: BholetraceEquation,
}

const FIRST_STEP: f64 = 0.5;
const MIN_STEPS: u32 = 30;
const MAX_STEPS: u32 = 100;
const CLOSE_ENOUGH: f64 = 1e-8;
const U_CAPTURED: f64 = 10.0;

impl BendingMethod for BholetraceSearch {
    fn info(&self) -> MethodInfo {
        let name = match self.equation {
            BholetraceEquation::Report => "bholetrace: search for r₀",
            BholetraceEquation::Shader => "bholetrace's shader: 3/2 = 1",
        };
        MethodInfo {
            name: name.to_owned(),
            knobs: String::new(),
            source: "bholetrace, rk4_r0.py",
            family: Family::Direct,
            landmark: true,
        }
    }

    fn serves(&self, observer: &Observer) -> bool {
        observer.is_at_infinity()
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        match self.search(initial.b).phi {
            Some(phi) => MethodOutcome::Escapes(2.0 * phi - std::f64::consts::PI),
            None => MethodOutcome::Captured,
        }
    }
}

/// The result of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// φ at the closest approach, rad; `None` for a captured ray.
    pub phi: Option<f64>,
    /// Steps taken.
    pub steps: u32,
}

impl BholetraceSearch {
    /// Searches along the ray with impact parameter `b`.
    pub fn search(&self, b: f64) -> Found {
        let (mut phi, mut u, mut v) = (0.0_f64, 0.0, 1.0 / b);
        let mut h = FIRST_STEP;
        for steps in 1..=MAX_STEPS {
            let (last_phi, last_u) = (phi, u);
            (u, v) = self.step(u, v, h);
            phi += h;
            if u > U_CAPTURED {
                return Found { phi: None, steps };
            }
            if steps > MIN_STEPS + 1 && (phi - last_phi).abs() < CLOSE_ENOUGH {
                return Found {
                    phi: Some(phi),
                    steps,
                };
            }
            if u < last_u {
                h *= -0.5;
            }
        }
        Found {
            phi: Some(phi),
            steps: MAX_STEPS,
        }
    }

    fn step(&self, u: f64, v: f64, h: f64) -> (f64, f64) {
        let strength = match self.equation {
            BholetraceEquation::Report => 1.5,
            BholetraceEquation::Shader => 1.0,
        };
        let f = |u: f64, v: f64| (v, u * (strength * u - 1.0));
        let (a1, b1) = f(u, v);
        let (a2, b2) = f(u + 0.5 * h * a1, v + 0.5 * h * b1);
        let (a3, b3) = f(u + 0.5 * h * a2, v + 0.5 * h * b2);
        let (a4, b4) = f(u + h * a3, v + h * b3);
        (
            u + h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4),
            v + h / 6.0 * (b1 + 2.0 * (b2 + b3) + b4),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_core::{B_CRIT, Ray, exact};

    /// The smallest b that escapes, by bisection.
    fn smallest_escaping(equation: BholetraceEquation) -> f64 {
        let search = BholetraceSearch { equation };
        let (mut captured, mut escaping) = (1.0, 4.0);
        for _ in 0..60 {
            let b = 0.5 * (captured + escaping);
            match search.search(b).phi {
                None => captured = b,
                Some(_) => escaping = b,
            }
        }
        escaping
    }

    #[test]
    fn the_shader_lets_rays_escape_from_1_7317_on() {
        let b = smallest_escaping(BholetraceEquation::Shader);
        assert!((b - 1.7317).abs() < 5e-5, "{b}");
    }

    #[test]
    fn the_report_has_the_shadow_right_to_a_permille() {
        let b = smallest_escaping(BholetraceEquation::Report);
        assert!((b / B_CRIT - 1.0).abs() < 1e-3, "{b}");
    }

    #[test]
    fn the_report_is_off_by_two_hundredths_of_a_radian() {
        let search = BholetraceSearch {
            equation: BholetraceEquation::Report,
        };
        let mut largest = 0.0_f64;
        for i in 0..=4000 {
            let b = B_CRIT * (1.0 + 10f64.powf(-2.0 + 4.0 * f64::from(i) / 4000.0));
            let closed = exact::bend(&Ray::from_infinity(b).unwrap());
            let error = search
                .bend(&InitialConditions::from_infinity(b))
                .bend()
                .unwrap()
                - closed.escaped().unwrap();
            largest = largest.max(error.abs());
        }
        assert!((largest / 1.9e-2 - 1.0).abs() < 0.01, "{largest:e}");
    }

    #[test]
    fn the_shader_bends_by_a_third_too_little() {
        let search = BholetraceSearch {
            equation: BholetraceEquation::Shader,
        };
        let bend = search
            .bend(&InitialConditions::from_infinity(10.0))
            .bend()
            .unwrap();
        let low = 1.0 - bend / 0.236_135_995_388_469_9;
        assert!((0.36..0.38).contains(&low), "{low}");
    }
}
