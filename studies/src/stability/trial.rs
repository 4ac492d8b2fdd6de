//! What the methods get for an input.

use crate::methods::InitialConditions;
use lensbake_core::{Observer, ShadowCoordinate};

/// What the methods get for an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// The observer whose rows the tables hold.
    pub observer: Observer,
    /// The initial conditions of the ray, as this observer sees it.
    pub initial: InitialConditions,
    /// What has to be added to a bending, rad: the view angle in the frame of the regime's observer minus that in the
    /// frame of [`Trial::observer`].
    pub aberration: f64,
}

/// The observer at rest at `r`. If none exists there, one at a finite radius takes its place, so that the methods that
/// serve finite observers are tried.
pub(super) fn at_rest(r: f64) -> Observer {
    let stand_in = || Observer::at(10.0).unwrap_or(Observer::at_infinity());
    Observer::at(r).unwrap_or_else(|_| stand_in())
}

/// The normalised shadow coordinate x = 1 − `gap`.
pub(super) fn at_edge(gap: f64) -> ShadowCoordinate {
    ShadowCoordinate {
        x: 1.0 - gap,
        one_minus_x: gap,
    }
}
