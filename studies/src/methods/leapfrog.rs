//! Leapfrog integration in Cartesian coordinates, as in most browser demonstrations.
//!
//! In the affine parameter λ the ray moves like a particle in a central force, with angular momentum L = b:
//!
//! ```text
//! d²x/dλ² = −(3/2) L² x / r⁵
//! ```
//!
//! This leads to the Binet equation of the black hole for u(φ), and so to the same bending.

use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};

/// Kick, drift, kick with steps proportional to r.
#[derive(Debug, Clone, Copy)]
pub struct Leapfrog {
    /// Step in λ as a fraction of r.
    pub step_over_r: f64,
}

/// Radius of the sky, in units of the largest of b, r and 1.
const SKY: f64 = 1e3;
/// Maximum number of steps of a ray.
const STEP_CAP: u32 = 1_000_000;

/// A particle in the plane of the ray, with the observer on the axis x > 0.
#[derive(Clone, Copy)]
struct Particle {
    at: [f64; 2],
    velocity: [f64; 2],
}

impl BendingMethod for Leapfrog {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "leapfrog, Cartesian".to_owned(),
            knobs: format!("step {} r", self.step_over_r),
            source: "Antonelli 2014, Starless, and many after it",
            family: Family::Direct,
            landmark: self.step_over_r == 0.03,
        }
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        let sky = SKY
            * initial.b.max(1.0).max(if initial.u > 0.0 {
                1.0 / initial.u
            } else {
                0.0
            });
        let mut particle = start(initial, sky);
        let mut turns = 0.0;
        for _ in 0..STEP_CAP {
            let before = particle;
            let r = before.at[0].hypot(before.at[1]);
            particle = self.step(before, r, initial.b);
            // The force turns the velocity in one sense only, so each passage through −x completes a turn.
            if before.velocity[1] >= 0.0 && particle.velocity[1] < 0.0 {
                turns += 1.0;
            }
            let [[x, y], [vx, vy]] = [particle.at, particle.velocity];
            let r = x.hypot(y);
            if r.is_nan() {
                return MethodOutcome::Escapes(f64::NAN);
            }
            if r <= 1.0 {
                return MethodOutcome::Captured;
            }
            if r > sky && x * vx + y * vy > 0.0 {
                use std::f64::consts::{PI, TAU};
                return MethodOutcome::Escapes(vy.atan2(vx) + turns * TAU - PI + initial.theta);
            }
        }
        MethodOutcome::Unfinished
    }
}

/// The particle at the observer; for the observer at infinity, at the radius of the sky.
fn start(initial: &InitialConditions, sky: f64) -> Particle {
    let InitialConditions { u, b, du_dphi, .. } = *initial;
    if u > 0.0 {
        return Particle {
            at: [1.0 / u, 0.0],
            velocity: [-b * du_dphi, b * u],
        };
    }
    // |v|² = 1 + b²/r³ with v = 1 at infinity.
    let speed = (1.0 + b * b / sky.powi(3)).sqrt();
    Particle {
        at: [sky, b / speed],
        velocity: [-speed, 0.0],
    }
}

impl Leapfrog {
    fn step(&self, particle: Particle, r: f64, b: f64) -> Particle {
        let h = self.step_over_r * r;
        let half = kick(particle.velocity, particle.at, b, 0.5 * h);
        let at = [0, 1].map(|i| particle.at[i] + h * half[i]);
        Particle {
            at,
            velocity: kick(half, at, b, 0.5 * h),
        }
    }
}

fn kick(velocity: [f64; 2], at: [f64; 2], b: f64, h: f64) -> [f64; 2] {
    let r_sq = at[0] * at[0] + at[1] * at[1];
    let pull = -1.5 * b * b / (r_sq * r_sq * r_sq.sqrt()) * h;
    [0, 1].map(|i| velocity[i] + pull * at[i])
}
