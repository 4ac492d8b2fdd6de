use crate::{MAX_DISTANCE, MIN_RADIUS};
use thiserror::Error;

/// Input for which no ray exists or none can be computed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CoreError {
    /// The observer's radius is not above the horizon.
    #[error(
        "radius {0} is not above the horizon: r must be greater than 1 (in units of r_s), unless the observer falls"
    )]
    Radius(f64),
    /// The radius is below [`MIN_RADIUS`], too close to the singularity.
    #[error("radius {0} is not from {MIN_RADIUS:e} to infinity (in units of r_s)")]
    Singularity(f64),
    /// There is no circular orbit at this radius.
    #[error(
        "there is no circular orbit at radius {0}: r must be greater than 1.5 (in units of r_s)"
    )]
    NoOrbit(f64),
    /// The velocity is not below that of light.
    #[error("a speed of {0} is not below 1, the speed of light")]
    Speed(f64),
    /// The radius or the impact parameter is finite, but too large to compute with.
    #[error(
        "{what} {found:e} is beyond {MAX_DISTANCE:e}, the largest that is computed with; an observer \
         at infinity is `inf`"
    )]
    TooFar {
        /// Name of the quantity: radius or impact parameter.
        what: &'static str,
        /// The value given.
        found: f64,
    },
    /// The view angle is outside [0, π].
    #[error("view angle {0} rad is outside 0 to π")]
    ViewAngle(f64),
    /// The impact parameter is not a positive number.
    #[error("impact parameter {0} is not a positive finite number")]
    ImpactParameter(f64),
    /// The observer has no view angles: at infinity, or in the row frame at the horizon and below.
    #[error("an observer at infinity has an impact parameter, not a view angle")]
    NoViewAngle,
}
