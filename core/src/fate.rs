/// What becomes of a light ray followed backwards from the observer.
///
/// Capture is a variant, never a sentinel number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fate<T = f64> {
    /// The ray comes from the sky; the value says from where (most often the bending Δ, in rad).
    Escapes(T),
    /// The ray comes from the horizon: the observer sees black.
    Captured,
}

impl<T> Fate<T> {
    /// The value of an escaping ray, `None` for a captured one.
    pub fn escaped(self) -> Option<T> {
        match self {
            Fate::Escapes(value) => Some(value),
            Fate::Captured => None,
        }
    }

    /// Applies `f` to the value of an escaping ray.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Fate<U> {
        match self {
            Fate::Escapes(value) => Fate::Escapes(f(value)),
            Fate::Captured => Fate::Captured,
        }
    }
}
