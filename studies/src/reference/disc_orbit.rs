//! The orbit of a light ray that is looked for on a disc: integrated in f64 from the observer, in one piece.

use lensbake_core::{B_CRIT, Observer, rk4};
use std::f64::consts::PI;

/// Step in the orbital angle where the field is weak, rad; its error is below 1e-8 rad per radian.
const STEP: f64 = 0.03;
/// A ray that has gone round the hole so often counts as captured, rad.
const LONGEST: f64 = 20.0 * PI;

/// A light ray traced backwards from the observer by its inverse radius u(φ), with φ the orbital angle from the
/// observer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// u at the observer, and du/dφ: positive towards the hole.
    start: [f64; 2],
    /// b, the angular momentum of the light over its energy at infinity.
    pub impact_parameter: f64,
}

/// Where a ray ends, traced backwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// At the horizon.
    Horizon,
    /// At infinity, at this orbital angle from the observer, rad.
    Infinity(f64),
    /// Where it was stopped.
    Stopped,
}

/// u″ = −u + 3/2 u².
fn binet(&[u, slope]: &[f64; 2]) -> [f64; 2] {
    [slope, 1.5 * u * u - u]
}

impl Orbit {
    /// The ray that `observer` sees at the view angle `theta` (rad). `None` if it is radial, or below the horizon has not
    /// come from outside.
    pub fn of(observer: &Observer, theta: f64) -> Option<Self> {
        let x = observer.shadow_coordinate(theta).x;
        let cos = observer.cos_shadow_at_rest();
        let (inwards, outwards) = ((1.0 + cos) * x, (1.0 - cos) / x);
        let inverse_b = (inwards + outwards) / (2.0 * B_CRIT);
        let slope = (inwards - outwards) / (2.0 * B_CRIT);
        (inverse_b > 0.0 && inverse_b.is_finite()).then(|| Orbit {
            start: [observer.inverse_radius(), slope],
            impact_parameter: 1.0 / inverse_b,
        })
    }

    /// Follows the ray to its end. `crossed` is called with the radius at the orbital angle `crossing` (rad, above 0), and
    /// after each further half of a turn; the ray is stopped when it returns false.
    pub fn follow(self, mut crossing: f64, mut crossed: impl FnMut(f64) -> bool) -> End {
        let (mut state, mut phi) = (self.start, 0.0);
        while phi < LONGEST {
            let step = STEP / (1.0 + state[0]);
            while crossing <= phi + step {
                let [u, _] = rk4::step(&binet, &state, crossing - phi);
                if u <= 0.0 {
                    break;
                }
                if !crossed(1.0 / u) {
                    return End::Stopped;
                }
                crossing += PI;
            }
            let next = rk4::step(&binet, &state, step);
            if next[0] <= 0.0 {
                return End::Infinity(phi + angle_to_infinity(state));
            }
            if next[0] >= 1.0 && next[1] >= 0.0 {
                return End::Horizon;
            }
            (state, phi) = (next, phi + step);
        }
        End::Horizon
    }
}

/// The orbital angle from `state`, which is less than a step from infinity, to u = 0, by Newton's method.
fn angle_to_infinity(state: [f64; 2]) -> f64 {
    let mut angle = 0.0;
    for _ in 0..4 {
        let [u, slope] = rk4::step(&binet, &state, angle);
        angle -= u / slope;
    }
    angle
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_core::{RayOutcome, exact, orbit};
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn rays_end_where_the_closed_form_says() {
        let mut escaped = 0;
        for observer in [
            Observer::at(25.0),
            Observer::at(1.2),
            Observer::falling(4.0),
            Observer::falling(1.0),
            Observer::falling(0.2),
        ] {
            let observer = observer.unwrap();
            for i in 1..60 {
                let theta = PI * f64::from(i) / 60.0;
                let ray = observer.ray(theta).unwrap();
                let end = Orbit::of(&observer, theta).map(|orbit| orbit.follow(1.0, |_| true));
                match (exact::bend(&ray), end) {
                    (RayOutcome::Captured, None | Some(End::Horizon)) => (),
                    (RayOutcome::Escapes(bend), Some(End::Infinity(phi))) => {
                        let off = phi - (PI - theta + bend);
                        assert!(off.abs() < 1e-5, "{observer:?} {theta}: {off:e}");
                        escaped += 1;
                    }
                    other => panic!("{observer:?} {theta}: {other:?}"),
                }
            }
        }
        assert!(escaped > 150, "{escaped}");
    }

    #[test]
    fn crossings_lie_on_the_orbit_of_the_closed_form() {
        // Without an aberration of its own, an observer far away sees the orbit from infinity.
        let observer = Observer::at(1e6).unwrap();
        for b in [2.7, 4.0, 7.0, 30.0] {
            let theta = (b * 1e-6 * observer.lapse()).asin();
            let mut radii = Vec::new();
            Orbit::of(&observer, theta).unwrap().follow(FRAC_PI_2, |r| {
                radii.push(r);
                true
            });
            let phase = FRAC_PI_2 + orbit::phase(1.0 / b, 1e-6).unwrap();
            let known = 1.0 / orbit::inverse_radius(1.0 / b, phase);
            assert!(
                (radii[0] / known - 1.0).abs() < 1e-7,
                "{b}: {radii:?} {known}"
            );
        }
    }
}
