use lensbake_core::{CoreError, Fate};

/// What a method answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// The ray escapes with this bending Δ, rad; NaN if that is what came out.
    Escapes(f64),
    /// The ray is captured.
    Captured,
    /// The method gave up at its cap of steps.
    Unfinished,
    /// The method refuses the input in words.
    Refused(CoreError),
}

impl Outcome {
    /// The bending of a ray that escapes, rad.
    pub fn bend(self) -> Option<f64> {
        match self {
            Outcome::Escapes(bend) => Some(bend),
            _ => None,
        }
    }
}

impl From<Fate> for Outcome {
    fn from(fate: Fate) -> Self {
        match fate {
            Fate::Escapes(bend) => Outcome::Escapes(bend),
            Fate::Captured => Outcome::Captured,
        }
    }
}
