//! Test rays of observers in motion.

use super::rays::{EDGE_GAP, ObservedRay, R_MIN, edge_gap, off_edge, random, random_direction};
use crate::{Header, Rows};
use fastrand::Rng;
use lensbake_core::{Boost, CoreError, Motion, MovingFrame, Observer, R_PHOTON};
use std::f64::consts::{PI, TAU};

/// A ray as an observer in any motion sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameRay {
    /// The ray as the observer in radial motion sees it, relative to whom the observer's boost is
    /// ([`MovingFrame::observer`]).
    pub observed: ObservedRay,
    /// View angle from the direction of the hole in the observer's own frame, rad; 0 at infinity.
    pub theta: f64,
    /// Azimuth about that direction, from the direction of motion, in the observer's own frame, rad; `None` if the
    /// motion is radial.
    pub azimuth: Option<f64>,
    /// Factor by which small angles are larger in the frame of `observed` than in the observer's own: the Doppler
    /// factor of the boost.
    pub doppler: f64,
}

impl FrameRay {
    /// View angle in the observer's own frame minus that in the frame of [`FrameRay::observed`], rad: what the boost
    /// adds to the bending.
    pub fn aberration(&self) -> f64 {
        let ObservedRay { observer, at } = self.observed;
        self.theta - observer.view_angle(at.x)
    }

    /// The ray that `observed` sees at `azimuth` (rad), as the observer sees it who moves by `boost` relative to him.
    fn boosted(observed: ObservedRay, azimuth: f64, boost: Boost) -> Self {
        let theta = observed.observer.view_angle(observed.at.x);
        let (own, inverse) = boost.inverse().unboosted(unit(theta, azimuth));
        let (theta, azimuth) = angles(own);
        FrameRay {
            observed,
            theta,
            azimuth: Some(azimuth),
            doppler: 1.0 / inverse,
        }
    }
}

impl From<ObservedRay> for FrameRay {
    /// The ray of an observer whose motion is radial.
    fn from(observed: ObservedRay) -> Self {
        FrameRay {
            observed,
            theta: observed.observer.view_angle(observed.at.x),
            azimuth: None,
            doppler: 1.0,
        }
    }
}

impl AsRef<ObservedRay> for FrameRay {
    fn as_ref(&self) -> &ObservedRay {
        &self.observed
    }
}

/// Smallest radius of the observers in orbit of random rays, above [`R_PHOTON`] by more than the rounding of a radius.
const R_MIN_ORBIT: f64 = R_PHOTON + 1e-9;

/// `count` random rays for `table` of observers in this motion, the same for the same seed. For observers at rest they
/// are those of [`random`].
///
/// Radii are uniform in χ from infinity to the horizon in free fall, to 1.5 in orbit, and to [`R_MIN`] at a velocity,
/// or the radius is the table's own. In free fall, half of the observers are at or below the horizon if the table has
/// rows there: uniform in ln r down to its last row.
///
/// Half of the directions are uniform in the view angle from the shadow boundary to straight away from the hole, in the
/// observer's own frame. For an observer whose motion is not radial, it is the angle from the middle of the shadow as
/// he sees it, at a random azimuth. The other half are concentrated near the shadow boundary, as with [`random`].
///
/// # Errors
/// [`CoreError`] if nobody can move so at the only radius that the table is for.
pub fn random_in_motion(
    table: &Header,
    motion: Motion,
    count: usize,
    seed: u64,
) -> Result<Vec<FrameRay>, CoreError> {
    if motion == Motion::Rest {
        if matches!(table.rows, Rows::One { .. }) {
            Observer::at(table.r_min())?;
        }
        let rays = random(table, count, seed);
        return Ok(rays.into_iter().map(FrameRay::from).collect());
    }
    let mut rng = Rng::with_seed(seed);
    let ray = |_| {
        let frame = MovingFrame::new(random_radius(table, motion, &mut rng), motion)?;
        Ok(match frame.boost() {
            None => random_direction(table.axis, *frame.observer(), &mut rng).into(),
            Some(boost) => random_boosted(&frame, boost, &mut rng),
        })
    };
    (0..count).map(ray).collect()
}

fn random_radius(table: &Header, motion: Motion, rng: &mut Rng) -> f64 {
    let below = match table.rows {
        Rows::One { .. } => return table.r_min(),
        Rows::Chi { .. } => false,
        Rows::ThroughHorizon { .. } => motion == Motion::Fall && rng.bool(),
    };
    if below {
        return table.r_min().powf(rng.f64());
    }
    let lowest: f64 = match motion {
        Motion::Fall => 1.0,
        Motion::Orbit => R_MIN_ORBIT,
        Motion::Rest | Motion::Velocity { .. } => R_MIN,
    };
    let chi_max = (1.0 / lowest).sqrt().asin();
    let sin = (rng.f64() * chi_max).sin();
    1.0 / (sin * sin)
}

fn random_boosted(frame: &MovingFrame, boost: Boost, rng: &mut Rng) -> FrameRay {
    let observer = *frame.observer();
    let (crowd, t, azimuth) = (rng.bool(), rng.f64(), TAU * rng.f64());
    if crowd {
        let at = edge_gap(EDGE_GAP.powf(t));
        return FrameRay::boosted(ObservedRay { observer, at }, azimuth, boost);
    }
    let (theta, azimuth) = Shadow::seen(&observer, boost).outside(t, azimuth);
    let seen = frame.unboosted(theta, azimuth);
    let at = off_edge(observer.shadow_coordinate(seen.theta));
    FrameRay::boosted(ObservedRay { observer, at }, seen.azimuth, boost)
}

/// The shadow as an observer in motion sees it: a circle, since a boost is conformal, in whose plane of symmetry lie
/// the direction of the hole and that of the motion.
struct Shadow {
    /// Angle of the middle from the direction of the hole, towards the direction of motion, rad.
    middle: f64,
    /// Angular radius, rad.
    radius: f64,
}

impl Shadow {
    /// The shadow of the observer who moves by `boost` relative to `observer`.
    fn seen(observer: &Observer, boost: Boost) -> Self {
        let ahead = boost.direction[1].atan2(boost.direction[0]);
        // Scales tan(α/2) by 1/k, α being the angle from the direction of motion; α may be beyond ±π.
        let own = |angle: f64| {
            let (sin, cos) = (0.5 * (angle - ahead)).sin_cos();
            ahead + 2.0 * sin.atan2(boost.doppler * cos)
        };
        let edge = observer.shadow_angle();
        let ends = [own(-edge), own(edge)];
        Shadow {
            middle: 0.5 * (ends[0] + ends[1]),
            radius: 0.5 * (ends[1] - ends[0]),
        }
    }

    /// The view angle and azimuth (rad) of the direction at the fraction `t` of the angles from the shadow boundary to
    /// opposite the middle, at `turn` (rad) about the middle.
    fn outside(&self, t: f64, turn: f64) -> (f64, f64) {
        let [along, right, across] = unit(self.radius + t * (PI - self.radius), turn);
        let (sin, cos) = self.middle.sin_cos();
        angles([along * cos - right * sin, along * sin + right * cos, across])
    }
}

/// The unit vector at the angle `theta` from the first axis and at `azimuth` about it from the second, rad.
fn unit(theta: f64, azimuth: f64) -> [f64; 3] {
    let ((sin, cos), (across, along)) = (theta.sin_cos(), azimuth.sin_cos());
    [cos, sin * along, sin * across]
}

/// The inverse of [`unit`].
fn angles(n: [f64; 3]) -> (f64, f64) {
    (n[1].hypot(n[2]).atan2(n[0]), n[2].atan2(n[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::default_atlas;

    const FAST: Motion = Motion::Velocity {
        radial: 0.3,
        tangential: 0.95,
    };

    fn rays(motion: Motion) -> Vec<FrameRay> {
        random_in_motion(default_atlas().header(), motion, 20_000, 5).unwrap()
    }

    #[test]
    fn radii_are_where_the_motion_is_possible() {
        for (motion, lowest, inside) in [
            (Motion::Fall, 0.01, 0.5),
            (Motion::Orbit, 1.5, 0.0),
            (FAST, R_MIN, 0.0),
        ] {
            let rays = rays(motion);
            let radii = || rays.iter().map(|ray| ray.observed.observer.radius());
            let smallest = radii().fold(f64::INFINITY, f64::min);
            assert!(
                smallest >= lowest && smallest < 1.01 * lowest,
                "{motion}: {smallest}"
            );
            assert!(radii().any(|r| r > 100.0), "{motion}");
            let below = rays
                .iter()
                .filter(|ray| ray.observed.observer.is_inside())
                .count();
            let part = below as f64 / rays.len() as f64;
            assert!((part - inside).abs() < 0.02, "{motion}: {part}");
        }
    }

    #[test]
    fn a_table_without_rows_below_the_horizon_gets_none_there() {
        let header = Header {
            rows: Rows::Chi { count: 128 },
            ..default_atlas().header().clone()
        };
        let rays = random_in_motion(&header, Motion::Fall, 1000, 5).unwrap();
        assert!(rays.iter().all(|ray| ray.observed.observer.radius() >= 1.0));
    }

    /// Half of the rays are uniform over the sky that the observer sees in his own frame, whatever the boost; half of
    /// the others have 1 − x below 1e-3.
    #[test]
    fn directions_fill_the_own_sky_and_crowd_the_shadow_boundary() {
        for motion in [Motion::Fall, Motion::Orbit, FAST] {
            let rays = rays(motion);
            let mut quarters = [0; 4];
            for ray in &rays {
                let observer = ray.observed.observer;
                let frame = MovingFrame::new(observer.radius(), motion).unwrap();
                let shadow = match frame.boost() {
                    None => Shadow {
                        middle: 0.0,
                        radius: observer.shadow_angle(),
                    },
                    Some(boost) => Shadow::seen(&observer, boost),
                };
                let n = unit(ray.theta, ray.azimuth.unwrap_or(0.0));
                let cos = n[0] * shadow.middle.cos() + n[1] * shadow.middle.sin();
                let t = (cos.clamp(-1.0, 1.0).acos() - shadow.radius) / (PI - shadow.radius);
                quarters[((4.0 * t) as usize).min(3)] += 1;
            }
            let filled = quarters.iter().all(|&count| count > 2350);
            assert!(filled && quarters[3] < 3500, "{motion}: {quarters:?}");
            let close = rays.iter().filter(|ray| ray.observed.at.one_minus_x < 1e-3);
            assert!(close.count() > 4800, "{motion}");
        }
    }

    #[test]
    fn the_direction_in_the_own_frame_is_that_of_the_ray() {
        for motion in [Motion::Fall, Motion::Orbit, FAST] {
            for ray in rays(motion) {
                let ObservedRay { observer, at } = ray.observed;
                let frame = MovingFrame::new(observer.radius(), motion).unwrap();
                let seen = frame.unboosted(ray.theta, ray.azimuth.unwrap_or(0.0));
                let theta = observer.view_angle(at.x);
                assert!(
                    (seen.theta - theta).abs() < 1e-12 * seen.doppler.max(1.0),
                    "{ray:?}"
                );
                assert!((seen.doppler / ray.doppler - 1.0).abs() < 1e-9, "{ray:?}");
                assert!(at.one_minus_x >= EDGE_GAP, "{ray:?}");
            }
        }
    }

    #[test]
    fn a_motion_that_the_table_has_no_observer_for_is_refused() {
        let header = Header {
            rows: Rows::One {
                inverse_radius: 0.8,
            },
            ..default_atlas().header().clone()
        };
        assert!(random_in_motion(&header, Motion::Fall, 10, 1).is_ok());
        let refused = random_in_motion(&header, Motion::Orbit, 10, 1);
        assert_eq!(refused, Err(CoreError::NoOrbit(1.25)));
        let below = Header {
            rows: Rows::One {
                inverse_radius: 2.0,
            },
            ..header
        };
        assert!(random_in_motion(&below, Motion::Fall, 10, 1).is_ok());
        let refused = random_in_motion(&below, Motion::Rest, 10, 1);
        assert_eq!(refused, Err(CoreError::Radius(0.5)));
    }
}
