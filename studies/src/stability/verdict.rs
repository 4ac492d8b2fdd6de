use super::Truth;
use crate::methods::MethodOutcome;
use std::fmt;
use std::str::FromStr;

/// Largest error of a right answer, rad. The shipped table's error stays well below it.
pub const TOLERANCE: f64 = 1e-6;

/// The result of comparing an answer with the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// The outcome is right and the error at most [`TOLERANCE`].
    Right,
    /// The outcome is right and the error is this, rad.
    Off(f64),
    /// Captured instead of escaping, or escaping instead of captured.
    WrongOutcome,
    /// The bending is NaN.
    NotANumber,
    /// The method reached its maximum number of steps.
    Unfinished,
    /// Rightly refused with an error: the input is not a ray.
    Refused,
    /// Refused with an error, although the ray exists.
    RefusedRay,
    /// Answered, although the input is not a ray.
    Nonsense,
    /// The method is for other observers only and was not tried.
    NotServed,
}

impl Verdict {
    /// The verdict on `outcome`, given the truth.
    pub fn of(outcome: MethodOutcome, truth: Truth) -> Self {
        match (outcome, truth) {
            (MethodOutcome::Refused(_), Truth::NoRay) => Verdict::Refused,
            (MethodOutcome::Refused(_), _) => Verdict::RefusedRay,
            (MethodOutcome::Unfinished, _) => Verdict::Unfinished,
            (MethodOutcome::Escapes(bend), _) if bend.is_nan() => Verdict::NotANumber,
            (_, Truth::NoRay) => Verdict::Nonsense,
            (MethodOutcome::Captured, Truth::Captured) => Verdict::Right,
            (MethodOutcome::Escapes(bend), Truth::Escapes(truth)) => {
                let error = (bend - truth).abs();
                if error <= TOLERANCE {
                    Verdict::Right
                } else {
                    Verdict::Off(error)
                }
            }
            _ => Verdict::WrongOutcome,
        }
    }

    /// Whether the answer is right or rightly refused.
    pub fn is_good(self) -> bool {
        matches!(self, Verdict::Right | Verdict::Refused)
    }

    /// Whether both are of the same kind with errors within a decade of each other, or one is right and the other
    /// off by at most twice the tolerance: the last digits of sines and logarithms differ from machine to machine.
    pub fn agrees_with(self, other: &Verdict) -> bool {
        match (self, *other) {
            (Verdict::Off(a), Verdict::Off(b)) => a == b || (a.log10() - b.log10()).abs() <= 1.0,
            (Verdict::Off(error), Verdict::Right) | (Verdict::Right, Verdict::Off(error)) => {
                error <= 2.0 * TOLERANCE
            }
            (a, b) => a == b,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Verdict::Off(error) => return write!(f, "{error:.0e}"),
            Verdict::Right => "right",
            Verdict::WrongOutcome => "wrong outcome",
            Verdict::NotANumber => "NaN",
            Verdict::Unfinished => "unfinished",
            Verdict::Refused => "refused",
            Verdict::RefusedRay => "refused a ray",
            Verdict::Nonsense => "nonsense",
            Verdict::NotServed => "not served",
        })
    }
}

/// A text that is not a verdict.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is no verdict")]
pub struct NoVerdict(String);

impl FromStr for Verdict {
    type Err = NoVerdict;

    fn from_str(text: &str) -> Result<Self, NoVerdict> {
        const WORDS: [Verdict; 8] = [
            Verdict::Right,
            Verdict::WrongOutcome,
            Verdict::NotANumber,
            Verdict::Unfinished,
            Verdict::Refused,
            Verdict::RefusedRay,
            Verdict::Nonsense,
            Verdict::NotServed,
        ];
        let word = WORDS
            .into_iter()
            .find(|verdict| verdict.to_string() == text);
        let off = || {
            text.parse()
                .ok()
                .filter(|e: &f64| !e.is_nan())
                .map(Verdict::Off)
        };
        word.or_else(off).ok_or_else(|| NoVerdict(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_core::CoreError;

    #[test]
    fn each_answer_gets_its_verdict() {
        let refusal = MethodOutcome::Refused(CoreError::Radius(0.5));
        let (one, none) = (Truth::Escapes(1.0), Truth::NoRay);
        for (outcome, truth, verdict) in [
            (MethodOutcome::Escapes(1.0 + 1e-7), one, "right"),
            (MethodOutcome::Escapes(1.01), one, "1e-2"),
            (MethodOutcome::Escapes(f64::INFINITY), one, "inf"),
            (MethodOutcome::Captured, one, "wrong outcome"),
            (
                MethodOutcome::Escapes(1.0),
                Truth::Captured,
                "wrong outcome",
            ),
            (MethodOutcome::Captured, Truth::Captured, "right"),
            (MethodOutcome::Escapes(f64::NAN), Truth::Captured, "NaN"),
            (MethodOutcome::Unfinished, one, "unfinished"),
            (refusal, none, "refused"),
            (refusal, one, "refused a ray"),
            (MethodOutcome::Captured, none, "nonsense"),
        ] {
            assert_eq!(Verdict::of(outcome, truth).to_string(), verdict);
            let read: Verdict = verdict.parse().unwrap();
            assert!(Verdict::of(outcome, truth).agrees_with(&read), "{verdict}");
        }
        assert!(!Verdict::Right.agrees_with(&Verdict::Off(1e-5)));
        assert!(!Verdict::Off(1e-5).agrees_with(&Verdict::Off(2e-4)));
        assert!("perhaps".parse::<Verdict>().is_err());
    }
}
