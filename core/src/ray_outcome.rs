/// The outcome of a light ray traced backwards from the observer.
///
/// Capture is a variant, never a sentinel number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RayOutcome<T = f64> {
    /// The ray comes from the sky. Holds what was computed for it: usually the bending Δ, in rad.
    Escapes(T),
    /// The ray comes from the horizon: the observer sees black.
    Captured,
}

impl<T> RayOutcome<T> {
    /// The value of an escaping ray, `None` for a captured one.
    pub fn escaped(self) -> Option<T> {
        match self {
            RayOutcome::Escapes(value) => Some(value),
            RayOutcome::Captured => None,
        }
    }

    /// Applies `f` to the value of an escaping ray.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> RayOutcome<U> {
        match self {
            RayOutcome::Escapes(value) => RayOutcome::Escapes(f(value)),
            RayOutcome::Captured => RayOutcome::Captured,
        }
    }
}
