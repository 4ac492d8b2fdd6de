//! Inputs for observers in motion.
//!
//! Every method gets the ray as the observer at rest at the same place sees it, at the horizon and below in the limit of
//! [`in_row_frame`](lensbake_core::Observer::in_row_frame), and the difference of the view angles is added to its
//! bending. So no method knows of motion, and all of them are served by the same aberration, that of `lensbake_core`.

use super::trial::{Trial, at_edge, at_rest};
use crate::methods::InitialConditions;
use lensbake_core::{CoreError, Motion, MovingFrame};
use lensbake_tables::baking::ObservedRay;

/// An observer in motion, and a direction in which he looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InMotion {
    /// The motion.
    pub motion: Motion,
    /// Radius.
    pub r: f64,
    /// Where he looks.
    pub direction: Direction,
}

/// A direction in the frame of an observer in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    /// The normalised shadow coordinate x = 1 − gap, in free fall.
    AtEdge {
        /// 1 − x.
        gap: f64,
    },
    /// An angle and an azimuth.
    View {
        /// View angle from the direction of the hole, rad.
        theta: f64,
        /// Azimuth about that direction, from the direction of motion, rad.
        azimuth: f64,
    },
}

impl InMotion {
    /// What the methods get.
    pub(super) fn trial(self) -> Trial {
        let (seen, theta) = match self.seen() {
            Ok(seen) => seen,
            Err(error) => return self.without_observer(error),
        };
        let (observer, at) = (seen.observer.in_row_frame(), seen.at);
        Trial {
            observer,
            initial: InitialConditions::of(&ObservedRay { observer, at }),
            aberration: theta - observer.view_angle(at.x),
        }
    }

    /// The ray as the observer in radial motion sees it, relative to whom the boost is, and the view angle in the frame
    /// of the observer himself, rad.
    fn seen(self) -> Result<(ObservedRay, f64), CoreError> {
        let frame = MovingFrame::new(self.r, self.motion)?;
        let observer = *frame.observer();
        let (at, theta) = match self.direction {
            Direction::AtEdge { gap } => {
                let at = at_edge(gap);
                (at, observer.view_angle(at.x))
            }
            Direction::View { theta, azimuth } => {
                let seen = frame.unboosted(theta, azimuth);
                (observer.shadow_coordinate(seen.theta), theta)
            }
        };
        Ok((ObservedRay { observer, at }, theta))
    }

    /// What the methods get if there is no such observer: the project's own the error, the others the numbers as if for
    /// an observer at rest.
    fn without_observer(self, error: CoreError) -> Trial {
        let theta = match self.direction {
            Direction::AtEdge { .. } => f64::NAN,
            Direction::View { theta, .. } => theta,
        };
        Trial {
            observer: at_rest(self.r),
            initial: InitialConditions {
                ray: Err(error),
                ..InitialConditions::from_view(self.r, theta)
            },
            aberration: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::tests::check;
    use crate::stability::{Input, regimes};
    use lensbake_core::{RayOutcome, exact};

    /// The bending as `bake query` computes it: by the ray of the moving observer, not by that of the one at rest.
    fn bend(input: InMotion) -> Result<RayOutcome, CoreError> {
        let frame = MovingFrame::new(input.r, input.motion)?;
        match input.direction {
            Direction::AtEdge { gap } => Ok(exact::bend(&frame.observer().ray_at(at_edge(gap)))),
            Direction::View { theta, azimuth } => {
                let seen = frame.unboosted(theta, azimuth);
                let bend = exact::bend(&frame.observer().ray(seen.theta)?);
                Ok(bend.map(|bend| bend + (theta - seen.theta)))
            }
        }
    }

    #[test]
    fn the_closed_form_of_the_moving_observer_is_that_in_60_digits() {
        let mut compared = 0;
        for regime in regimes() {
            if let Input::InMotion(input) = regime.input {
                check(&regime, bend(input));
                compared += 1;
            }
        }
        assert!(compared > 70, "{compared}");
    }
}
