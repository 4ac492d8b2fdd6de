//! The deflection angle by direct integration of the Binet equation with RK4.
//!
//! Weak and strong fields need different variables, so that small quantities are carried and not computed by
//! subtraction. With y = u in weak fields and y = w = 2/3 − u in strong ones, the equation has the same form,
//!
//! ```text
//! y″ = σ (y − (3/2) y²),     σ = −1 for u, +1 for w.
//! ```
//!
//! A near-critical ray lingers near its periapsis or near its crossing of the photon sphere. Integration starts at
//! that point, which keeps the relative error of the state small there, and with it the error of φ. φ_∞ is then
//! the sum of two arms (Weinberg's Δφ = 2|φ(r₀) − φ_∞| − π for an observer at infinity).

use crate::rk4::{Event, Stepper, march};
use crate::{Observer, Path, Ray, RayOutcome, ShadowCoordinate, U_PHOTON};

/// The bending Δ (deflection angle) and its slope along the normalised shadow coordinate x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BendAndSlope {
    /// Δ, rad.
    pub bend: f64,
    /// dΔ/dx at fixed r, rad.
    pub slope: f64,
}

/// The bending Δ of `ray` in rad, by RK4. With [`Stepper::Adaptive`] the error is about the tolerance times φ_∞,
/// but not below 1e-14 + ε/(1−x), where ε is the rounding error of the initial conditions.
///
/// If the integration fails (a fixed step far too long), the result is NaN, which no check against a bound
/// accepts.
///
/// ```
/// use lensbake_core::rk4::Stepper;
/// use lensbake_core::{Observer, direct, exact};
///
/// let ray = Observer::at(10.0).unwrap().ray(0.5).unwrap();
/// let integrated = direct::bend(&ray, Stepper::Adaptive(1e-12)).escaped().unwrap();
/// let closed = exact::bend(&ray).escaped().unwrap();
/// assert!((integrated - closed).abs() < 1e-11);
/// ```
pub fn bend(ray: &Ray, stepper: Stepper) -> RayOutcome {
    match ray.path() {
        Path::Radial => RayOutcome::Escapes(0.0),
        _ => phi_infinity(ray, stepper).map(|phi| ray.bend_from_phi(phi)),
    }
}

/// φ_∞, the orbital angle of `ray` between the observer and infinity, in rad, by RK4. Accuracy and failure are as for
/// [`bend`].
pub fn phi_infinity(ray: &Ray, stepper: Stepper) -> RayOutcome {
    match ray.path() {
        Path::Radial => RayOutcome::Escapes(std::f64::consts::PI - ray.theta),
        _ => arms::<3>(ray, stepper).map(|arms| arms.phi_infinity()),
    }
}

/// The bending Δ and its slope dΔ/dx for `observer` at the normalised shadow coordinate `at`; x = 0 is included.
/// The slope comes from the variational equation δy″ = σ (1 − 3y) δy, integrated together with the orbit. Accuracy
/// and failure are as for [`bend`].
pub fn bend_and_slope(
    observer: &Observer,
    at: ShadowCoordinate,
    stepper: Stepper,
) -> RayOutcome<BendAndSlope> {
    if let Some(bending) = observer.bend_straight_away(at) {
        return RayOutcome::Escapes(bending);
    }
    let ray = observer.ray_at(at);
    if ray.path() == Path::Radial {
        return RayOutcome::Escapes(BendAndSlope {
            bend: 0.0,
            slope: observer.bend_slope_away(),
        });
    }
    arms::<5>(&ray, stepper).map(|arms| BendAndSlope {
        bend: ray.bend_from_phi(arms.phi_infinity()),
        slope: arms.phi_slope(&ray) + observer.view_angle_slope(at.x),
    })
}

/// The integration variable y.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Variable {
    U,
    W,
}

impl Variable {
    fn for_ray(ray: &Ray, u_max: f64) -> Self {
        if ray.w > 0.0 && u_max <= 1.0 / 3.0 {
            Variable::U
        } else {
            Variable::W
        }
    }

    /// σ, which is also dy/dw.
    fn sigma(self) -> f64 {
        match self {
            Variable::U => -1.0,
            Variable::W => 1.0,
        }
    }

    fn pick(self, u: f64, w: f64) -> f64 {
        match self {
            Variable::U => u,
            Variable::W => w,
        }
    }

    /// The right-hand side dY/dφ for Y = (φ, y, y′) or (φ, y, y′, δy, δy′).
    fn orbit<const N: usize>(self) -> impl Fn(&[f64; N]) -> [f64; N] {
        let sigma = self.sigma();
        move |y| {
            std::array::from_fn(|i| match i {
                0 => 1.0,
                1 => y[2],
                2 => sigma * (y[1] - 1.5 * y[1] * y[1]),
                3 => y[4],
                _ => sigma * (1.0 - 3.0 * y[1]) * y[3],
            })
        }
    }
}

/// The states at the ends of the arms: `far` at infinity and, if the integration started between infinity and the
/// observer, `near` at the observer.
///
/// The variation δ is with respect to κ for paths with two arms, with respect to x for the outward path.
struct Arms<const N: usize> {
    variable: Variable,
    far: [f64; N],
    near: Option<[f64; N]>,
}

impl<const N: usize> Arms<N> {
    fn phi_infinity(&self) -> f64 {
        self.far[0] + self.near.map_or(0.0, |near| near[0])
    }

    /// dφ_∞/dx. At an event y = const, dφ = −δy / y′.
    fn phi_slope(&self, ray: &Ray) -> f64 {
        let sigma = self.variable.sigma();
        let far_dphi = -self.far[3] / self.far[2];
        let Some(near) = self.near else {
            return far_dphi;
        };
        // dκ/dx = −2/b · (du/dφ)/x. At the observer y′ is ± du/dφ, which cancels analytically; this avoids 0/0 if
        // the observer is at the periapsis.
        let kappa_slope = -2.0 * ray.inv_b / ray.x;
        far_dphi * kappa_slope * ray.du_dphi - sigma * near[3] * kappa_slope
    }
}

/// The N components of a state; N = 3 leaves out the variation.
fn state<const N: usize>(y: f64, y_prime: f64, delta: f64, delta_prime: f64) -> [f64; N] {
    let all = [0.0, y, y_prime, delta, delta_prime];
    std::array::from_fn(|i| all[i])
}

/// The arms of a ray that is not radial; NaN if the integration failed.
fn arms<const N: usize>(ray: &Ray, stepper: Stepper) -> RayOutcome<Arms<N>> {
    let arms = match ray.path() {
        Path::Captured => return RayOutcome::Captured,
        Path::Radial => None,
        Path::ViaPeriapsis => via_periapsis(ray, stepper),
        Path::OverPhotonSphere => over_photon_sphere(ray, stepper),
        Path::Outward => outward(ray, stepper),
    };
    RayOutcome::Escapes(arms.unwrap_or(Arms {
        variable: Variable::W,
        far: [f64::NAN; N],
        near: None,
    }))
}

fn infinity(variable: Variable) -> Event {
    Event {
        index: 1,
        value: variable.pick(0.0, U_PHOTON),
    }
}

/// The event at the observer: given by the velocity near a turning point, otherwise by the position.
fn observer(ray: &Ray, variable: Variable, speed: f64) -> Event {
    let place = variable.pick(ray.u, ray.w);
    if (place - 1.5 * place * place).abs() > speed.abs() {
        Event {
            index: 2,
            value: speed,
        }
    } else {
        Event {
            index: 1,
            value: place,
        }
    }
}

fn via_periapsis<const N: usize>(ray: &Ray, stepper: Stepper) -> Option<Arms<N>> {
    let (u, w) = (ray.u_apsis(), ray.w_apsis());
    let variable = Variable::for_ray(ray, u);
    let sigma = variable.sigma();
    let apsis = state::<N>(variable.pick(u, w), 0.0, sigma / (3.0 * u * w), 0.0);
    let orbit = variable.orbit::<N>();
    let near = if ray.u == 0.0 {
        None
    } else {
        let place = observer(ray, variable, sigma * ray.du_dphi);
        Some(march(&orbit, apsis, place, stepper)?.state)
    };
    let far = march(&orbit, near.unwrap_or(apsis), infinity(variable), stepper)?.state;
    Some(Arms {
        variable,
        far,
        near: Some(near.unwrap_or(far)),
    })
}

fn over_photon_sphere<const N: usize>(ray: &Ray, stepper: Stepper) -> Option<Arms<N>> {
    let variable = Variable::W;
    let speed = (-ray.kappa).sqrt();
    let orbit = variable.orbit::<N>();
    let up = state::<N>(0.0, speed, 0.0, -0.5 / speed);
    // The arm down to the observer is integrated under the reflection φ → −φ.
    let down = state::<N>(0.0, -speed, 0.0, 0.5 / speed);
    let place = Event {
        index: 1,
        value: ray.w,
    };
    Some(Arms {
        variable,
        far: march(&orbit, up, infinity(variable), stepper)?.state,
        near: Some(march(&orbit, down, place, stepper)?.state),
    })
}

fn outward<const N: usize>(ray: &Ray, stepper: Stepper) -> Option<Arms<N>> {
    let variable = Variable::for_ray(ray, ray.u);
    let sigma = variable.sigma();
    // d(du/dφ)/dx at the observer, from (du/dφ)² = 1/b² − u² + u³ and d(1/b)/dx = (du/dφ)/x.
    let start = state::<N>(
        variable.pick(ray.u, ray.w),
        -sigma * ray.du_dphi,
        0.0,
        -sigma * ray.inv_b / ray.x,
    );
    let far = march(&variable.orbit::<N>(), start, infinity(variable), stepper)?.state;
    Some(Arms {
        variable,
        far,
        near: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact;

    const FINE: Stepper = Stepper::Adaptive(1e-12);

    /// The textbook method: integrates from the observer to infinity in one piece.
    fn bend_integrated_from_observer(ray: &Ray) -> f64 {
        let orbit = Variable::U.orbit::<3>();
        let start = [0.0, ray.u, ray.du_dphi];
        let arrival = march(&orbit, start, infinity(Variable::U), FINE).unwrap();
        ray.bend_from_phi(arrival.state[0])
    }

    #[test]
    fn anchors_do_not_change_the_answer() {
        let mut compared = 0;
        for r in [1.1, 1.4, 1.5, 1.6, 2.0, 5.0, 50.0] {
            let observer = Observer::at(r).unwrap();
            for s in [0.1, 0.3, 0.6, 0.9, 0.99] {
                let ray = observer.ray_at(ShadowCoordinate::from_s(s));
                let bend = bend(&ray, FINE).escaped().unwrap();
                let marched = bend_integrated_from_observer(&ray);
                assert!((bend - marched).abs() < 1e-9, "r {r} s {s}");
                compared += 1;
            }
        }
        assert_eq!(compared, 35);
    }

    #[test]
    fn the_slope_is_the_derivative_of_the_closed_form() {
        let mut compared = 0;
        let at_rest = [
            0.0,
            0.01,
            0.3,
            0.9,
            0.955_316_618,
            1.0,
            1.4,
            std::f64::consts::FRAC_PI_2,
        ]
        .map(Observer::at_chi);
        let falling = [20.0, 1.5, 1.0, 0.3, 0.05].map(|r| Observer::falling(r).unwrap());
        let row_frames = [1.0, 0.3, 0.02].map(|r| Observer::falling(r).unwrap().in_row_frame());
        for observer in at_rest.into_iter().chain(falling).chain(row_frames) {
            let exact_at = |x: f64| {
                let at = ShadowCoordinate {
                    x,
                    one_minus_x: 1.0 - x,
                };
                exact::bend(&observer.ray_at(at)).escaped().unwrap()
            };
            for x in [0.01, 0.2, 0.5, 0.8, 0.95] {
                let at = ShadowCoordinate {
                    x,
                    one_minus_x: 1.0 - x,
                };
                let slope = bend_and_slope(&observer, at, FINE).escaped().unwrap().slope;
                let h = 1e-4 * x.min(1.0 - x);
                let difference = |h: f64| (exact_at(x + h) - exact_at(x - h)) / (2.0 * h);
                let numeric = (4.0 * difference(h) - difference(2.0 * h)) / 3.0;
                assert!(
                    (slope - numeric).abs() < 1e-7 * (1.0 + slope.abs()),
                    "{observer:?} x {x}: {slope} {numeric}"
                );
                compared += 1;
            }
        }
        assert_eq!(compared, 80);
    }

    #[test]
    fn the_slope_is_continuous_straight_away() {
        let at_rest = [0.0, 0.01, 0.5, 1.0, 1.5, std::f64::consts::FRAC_PI_2].map(Observer::at_chi);
        let falling = [20.0, 1.5, 1.0, 0.3].map(|r| Observer::falling(r).unwrap());
        for observer in at_rest.into_iter().chain(falling) {
            let slope = |x: f64| {
                let at = ShadowCoordinate {
                    x,
                    one_minus_x: 1.0 - x,
                };
                bend_and_slope(&observer, at, FINE).escaped().unwrap().slope
            };
            assert!((slope(0.0) - slope(1e-8)).abs() < 1e-6, "{observer:?}");
        }
    }

    #[test]
    fn a_step_far_too_long_is_nan_or_wrong_but_ends() {
        let ray = Observer::at(10.0).unwrap().ray(0.3).unwrap();
        let bend = bend(&ray, Stepper::Fixed(1e3)).escaped().unwrap();
        assert!(bend.is_nan() || bend.is_finite());
    }
}
