use lensbake_core::{CoreError, Observer, Ray, ShadowCoordinate};
use lensbake_tables::baking::ObservedRay;

/// The initial conditions of a ray, in the variables that the different methods start from. Computing them costs
/// the same for all methods and is not timed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InitialConditions {
    /// 1/r of the observer; 0 at infinity.
    pub u: f64,
    /// View angle from the direction of the hole, rad; 0 at infinity.
    pub theta: f64,
    /// Impact parameter, units of r_s.
    pub b: f64,
    /// du/dφ = cos θ / b, positive towards the hole.
    pub du_dphi: f64,
    /// Normalised shadow coordinate, the argument of table lookups.
    pub at: ShadowCoordinate,
    /// The ray of `lensbake_core`, or why there is none.
    pub ray: Result<Ray, CoreError>,
}

impl InitialConditions {
    /// The initial conditions of the ray `ray`.
    pub fn of(ray: &ObservedRay) -> Self {
        let ObservedRay { observer, at } = *ray;
        let ray = observer.ray_at(at);
        let theta = observer.view_angle(at.x);
        InitialConditions {
            u: observer.inverse_radius(),
            theta,
            b: ray.impact_parameter(),
            du_dphi: theta.cos() / ray.impact_parameter(),
            at,
            ray: Ok(ray),
        }
    }

    /// Those of the ray from infinity with impact parameter `b`, which may be any number: the textbook methods use
    /// it as it is; this project's own methods return an error if there is no such ray.
    pub fn from_infinity(b: f64) -> Self {
        InitialConditions {
            u: 0.0,
            theta: 0.0,
            b,
            du_dphi: 1.0 / b,
            at: ShadowCoordinate::from_b(b),
            ray: Ray::from_infinity(b),
        }
    }

    /// Those of the ray of a static observer at `r` in the direction `theta` (rad), which may be any numbers.
    pub fn from_view(r: f64, theta: f64) -> Self {
        let b = r * theta.sin() / (1.0 - 1.0 / r).sqrt();
        let observer = Observer::at(r);
        let nowhere = ShadowCoordinate {
            x: f64::NAN,
            one_minus_x: f64::NAN,
        };
        InitialConditions {
            u: 1.0 / r,
            theta,
            b,
            du_dphi: theta.cos() / b,
            at: observer
                .as_ref()
                .map_or(nowhere, |observer| observer.shadow_coordinate(theta)),
            ray: observer.and_then(|observer| observer.ray(theta)),
        }
    }
}
