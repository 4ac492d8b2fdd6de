use super::Truth;
use crate::methods::Outcome;
use std::fmt;
use std::str::FromStr;

/// An answer this close to the truth is right, rad: what the shipped table stays well below.
pub const TOLERANCE: f64 = 1e-6;

/// What an answer is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// The fate is right and the error at most [`TOLERANCE`].
    Right,
    /// The fate is right and the error is this, rad.
    Off(f64),
    /// Captured for escaping, or escaping for captured.
    WrongFate,
    /// NaN.
    NotANumber,
    /// Gave up at its cap of steps.
    Unfinished,
    /// Refused in words, rightly: there is no such ray.
    Refused,
    /// Refused in words a ray that there is.
    RefusedRay,
    /// Answered as if there were such a ray.
    Nonsense,
    /// The method is for other observers only, and was not asked.
    NotServed,
}

impl Verdict {
    /// The verdict on `outcome` where `truth` is the case.
    pub fn of(outcome: Outcome, truth: Truth) -> Self {
        match (outcome, truth) {
            (Outcome::Refused(_), Truth::NoRay) => Verdict::Refused,
            (Outcome::Refused(_), _) => Verdict::RefusedRay,
            (Outcome::Unfinished, _) => Verdict::Unfinished,
            (Outcome::Escapes(bend), _) if bend.is_nan() => Verdict::NotANumber,
            (_, Truth::NoRay) => Verdict::Nonsense,
            (Outcome::Captured, Truth::Captured) => Verdict::Right,
            (Outcome::Escapes(bend), Truth::Escapes(truth)) => {
                let error = (bend - truth).abs();
                if error <= TOLERANCE {
                    Verdict::Right
                } else {
                    Verdict::Off(error)
                }
            }
            _ => Verdict::WrongFate,
        }
    }

    /// Right, or rightly refused.
    pub fn is_good(self) -> bool {
        matches!(self, Verdict::Right | Verdict::Refused)
    }

    /// The same kind, and an error of the same size within a decade, or within twice the tolerance: the
    /// last digits of sines and logarithms differ from machine to machine.
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
            Verdict::WrongFate => "wrong fate",
            Verdict::NotANumber => "NaN",
            Verdict::Unfinished => "unfinished",
            Verdict::Refused => "refused",
            Verdict::RefusedRay => "refused a ray",
            Verdict::Nonsense => "nonsense",
            Verdict::NotServed => "not served",
        })
    }
}

/// Text that is no verdict.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is no verdict")]
pub struct NoVerdict(String);

impl FromStr for Verdict {
    type Err = NoVerdict;

    fn from_str(text: &str) -> Result<Self, NoVerdict> {
        const WORDS: [Verdict; 8] = [
            Verdict::Right,
            Verdict::WrongFate,
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
        let refusal = Outcome::Refused(CoreError::Radius(0.5));
        let (one, none) = (Truth::Escapes(1.0), Truth::NoRay);
        for (outcome, truth, verdict) in [
            (Outcome::Escapes(1.0 + 1e-7), one, "right"),
            (Outcome::Escapes(1.01), one, "1e-2"),
            (Outcome::Escapes(f64::INFINITY), one, "inf"),
            (Outcome::Captured, one, "wrong fate"),
            (Outcome::Escapes(1.0), Truth::Captured, "wrong fate"),
            (Outcome::Captured, Truth::Captured, "right"),
            (Outcome::Escapes(f64::NAN), Truth::Captured, "NaN"),
            (Outcome::Unfinished, one, "unfinished"),
            (refusal, none, "refused"),
            (refusal, one, "refused a ray"),
            (Outcome::Captured, none, "nonsense"),
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
