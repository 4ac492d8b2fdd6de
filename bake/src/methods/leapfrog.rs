//! Leapfrog in Cartesian coordinates: what most demonstrations in the browser do.
//!
//! In the affine parameter λ the ray moves like a particle drawn by a force, L being b:
//!
//! ```text
//! d²x/dλ² = −(3/2) L² x / r⁵
//! ```
//!
//! which gives the Binet equation for u(φ) and so bends exactly as the hole does.

use super::{Card, Family, Launch, Method, Outcome};

/// Kick, drift, kick with steps that are a fraction of r.
#[derive(Debug, Clone, Copy)]
pub struct Leapfrog {
    /// Step in λ over r.
    pub step_over_r: f64,
}

/// The sky is this many times further than b and r.
const SKY: f64 = 1e3;
/// Steps after which a ray is given up.
const STEP_CAP: u32 = 1_000_000;

/// A particle in the plane of the ray; the observer is on the axis x > 0.
#[derive(Clone, Copy)]
struct Particle {
    at: [f64; 2],
    velocity: [f64; 2],
}

impl Method for Leapfrog {
    fn card(&self) -> Card {
        Card {
            name: "leapfrog, Cartesian".to_owned(),
            knobs: format!("step {} r", self.step_over_r),
            source: "Antonelli 2014, Starless, and many after it",
            family: Family::Direct,
            landmark: self.step_over_r == 0.03,
        }
    }

    fn bend(&self, launch: &Launch) -> Outcome {
        let sky = SKY
            * launch
                .b
                .max(1.0)
                .max(if launch.u > 0.0 { 1.0 / launch.u } else { 0.0 });
        let mut particle = start(launch, sky);
        let mut turns = 0.0;
        for _ in 0..STEP_CAP {
            let before = particle;
            let r = before.at[0].hypot(before.at[1]);
            particle = self.step(before, r, launch.b);
            // Attraction turns the velocity one way only: it has gone round when it passes −x.
            if before.velocity[1] >= 0.0 && particle.velocity[1] < 0.0 {
                turns += 1.0;
            }
            let [[x, y], [vx, vy]] = [particle.at, particle.velocity];
            let r = x.hypot(y);
            if r.is_nan() {
                return Outcome::Escapes(f64::NAN);
            }
            if r <= 1.0 {
                return Outcome::Captured;
            }
            if r > sky && x * vx + y * vy > 0.0 {
                use std::f64::consts::{PI, TAU};
                return Outcome::Escapes(vy.atan2(vx) + turns * TAU - PI + launch.theta);
            }
        }
        Outcome::Unfinished
    }
}

/// The particle at the observer, or for the one at infinity as far away as the sky is.
fn start(launch: &Launch, sky: f64) -> Particle {
    let Launch { u, b, du_dphi, .. } = *launch;
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
