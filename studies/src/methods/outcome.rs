use lensbake_core::{CoreError, RayOutcome};

/// The outcome of a ray according to a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MethodOutcome {
    /// The ray escapes with this bending Δ, rad; NaN if the method computed NaN.
    Escapes(f64),
    /// The ray is captured.
    Captured,
    /// The method reached its maximum number of steps.
    Unfinished,
    /// The method returned an error for the input.
    Refused(CoreError),
}

impl MethodOutcome {
    /// The bending of a ray that escapes, rad; `None` for any other outcome.
    pub fn bend(self) -> Option<f64> {
        match self {
            MethodOutcome::Escapes(bend) => Some(bend),
            _ => None,
        }
    }
}

impl From<RayOutcome> for MethodOutcome {
    fn from(outcome: RayOutcome) -> Self {
        match outcome {
            RayOutcome::Escapes(bend) => MethodOutcome::Escapes(bend),
            RayOutcome::Captured => MethodOutcome::Captured,
        }
    }
}
