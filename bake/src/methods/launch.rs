use crate::rays::Sight;
use lensbake_core::{CoreError, EdgeCoordinate, Observer, Ray};

/// A ray at its launch, in the numbers that each kind of method starts from. Computing them costs the
/// same for all and is not timed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Launch {
    /// 1/r of the observer, 0 at infinity.
    pub u: f64,
    /// View angle from the hole, rad; 0 at infinity.
    pub theta: f64,
    /// Impact parameter, units of r_s.
    pub b: f64,
    /// du/dφ = cos θ / b, positive towards the hole.
    pub du_dphi: f64,
    /// Edge coordinate, from which tables are looked up.
    pub at: EdgeCoordinate,
    /// The project's own ray, or why there is none.
    pub ray: Result<Ray, CoreError>,
}

impl Launch {
    /// The ray along a `sight`.
    pub fn of(sight: &Sight) -> Self {
        let Sight { observer, at } = *sight;
        let ray = observer.ray_at(at);
        let theta = observer.view_angle(at.x);
        Launch {
            u: observer.inverse_radius(),
            theta,
            b: ray.impact_parameter(),
            du_dphi: theta.cos() / ray.impact_parameter(),
            at,
            ray: Ok(ray),
        }
    }

    /// The ray from infinity with impact parameter `b`, whatever number that is: the textbook's
    /// methods get it as it is, the project's own refuse it in words where there is no ray.
    pub fn from_infinity(b: f64) -> Self {
        Launch {
            u: 0.0,
            theta: 0.0,
            b,
            du_dphi: 1.0 / b,
            at: EdgeCoordinate::from_b(b),
            ray: Ray::from_infinity(b),
        }
    }

    /// The ray of a static observer at `r` in the direction `theta` (rad), whatever numbers those are.
    pub fn from_view(r: f64, theta: f64) -> Self {
        let b = r * theta.sin() / (1.0 - 1.0 / r).sqrt();
        let observer = Observer::at(r);
        let nowhere = EdgeCoordinate {
            x: f64::NAN,
            one_minus_x: f64::NAN,
        };
        Launch {
            u: 1.0 / r,
            theta,
            b,
            du_dphi: theta.cos() / b,
            at: observer
                .as_ref()
                .map_or(nowhere, |observer| observer.edge_coordinate(theta)),
            ray: observer.and_then(|observer| observer.ray(theta)),
        }
    }
}
