//! Questions about single rays, as lines of text, and their answers.

use lensbake_core::rk4::Stepper;
use lensbake_core::{CoreError, Observer, Ray, RayOutcome, ShadowCoordinate, direct, exact};
use lensbake_tables::baking::ObservedRay;
use lensbake_tables::text::excerpt;
use lensbake_tables::{Row, Table, TableError};
use thiserror::Error;

/// Longest line that can be a question, bytes.
pub const MAX_LINE: usize = 4096;

/// A question about one ray: the observer and where he looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Question {
    /// The observer and the normalised shadow coordinate of his view direction.
    pub observed: ObservedRay,
    /// The ray, followed backwards from the observer.
    pub ray: Ray,
}

/// Why a line is not a question.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum QuestionError {
    /// The line is not UTF-8.
    #[error("it is not UTF-8 text")]
    NotText,
    /// The line is longer than [`MAX_LINE`].
    #[error("it is longer than {MAX_LINE} bytes")]
    TooLong,
    /// The line does not have two words.
    #[error("'{0}' is not `R THETA_DEG` or `inf B`")]
    Form(String),
    /// A word is not a number.
    #[error("'{0}' is not a number")]
    Number(String),
    /// The view angle is out of range.
    #[error("view angle {0} is outside 0 to 180 degrees")]
    ViewAngle(f64),
    /// The ray does not exist.
    #[error(transparent)]
    Ray(#[from] CoreError),
}

impl Question {
    /// Parses a line `R THETA_DEG` (the radius in units of r_s, the view angle from the direction of the hole in
    /// degrees) or `inf B` (the impact parameter in units of r_s). `None` for a blank line and for a comment,
    /// which begins with `#`.
    ///
    /// # Errors
    /// [`QuestionError`] says in one short line what is wrong.
    pub fn parse(line: &[u8]) -> Result<Option<Self>, QuestionError> {
        if line.len() > MAX_LINE {
            return Err(QuestionError::TooLong);
        }
        let line = std::str::from_utf8(line).map_err(|_| QuestionError::NotText)?;
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            return Ok(None);
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        let [first, second] = words[..] else {
            return Err(QuestionError::Form(excerpt(line)));
        };
        Question::new(number(first)?, number(second)?).map(Some)
    }

    /// The question for the observer at radius `r` and the view angle `second` in degrees; for the observer at
    /// infinity `second` is the impact parameter.
    fn new(r: f64, second: f64) -> Result<Self, QuestionError> {
        let observer = Observer::at(r)?;
        let (at, ray) = if observer.is_at_infinity() {
            let ray = Ray::from_infinity(second)?;
            (ShadowCoordinate::from_b(second), ray)
        } else {
            if !(0.0..=180.0).contains(&second) {
                return Err(QuestionError::ViewAngle(second));
            }
            let theta = second.to_radians();
            (observer.shadow_coordinate(theta), observer.ray(theta)?)
        };
        let observed = ObservedRay { observer, at };
        Ok(Question { observed, ray })
    }
}

/// How a bending is computed.
#[derive(Debug, Clone, Copy)]
pub enum QueryMethod<'a> {
    /// Looked up in a table.
    Lookup(&'a Table),
    /// Integrated by RK4 with this tolerance, rad per radian of orbital angle.
    Rk4(f64),
    /// Evaluated in closed form.
    Exact,
}

/// Answers questions by one method.
#[derive(Debug)]
pub struct Answers<'a> {
    method: QueryMethod<'a>,
    /// The row last mixed from the table; successive questions often have the same observer.
    row: Option<Row>,
}

impl<'a> Answers<'a> {
    /// Answers by `method`.
    pub fn new(method: QueryMethod<'a>) -> Self {
        Answers { method, row: None }
    }

    /// The outcome of the ray, with its bending in rad.
    ///
    /// # Errors
    /// [`TableError`] if the table holds another observer's row, or its axis does not reach the ray.
    pub fn answer(&mut self, question: &Question) -> Result<RayOutcome, TableError> {
        match self.method {
            QueryMethod::Lookup(table) => self.look_up(table, question.observed),
            QueryMethod::Rk4(tolerance) => {
                Ok(direct::bend(&question.ray, Stepper::Adaptive(tolerance)))
            }
            QueryMethod::Exact => Ok(exact::bend(&question.ray)),
        }
    }

    fn look_up(&mut self, table: &Table, ray: ObservedRay) -> Result<RayOutcome, TableError> {
        table.header().axis.check_reach(ray.at)?;
        let row = match self.row.take() {
            Some(row) if *row.observer() == ray.observer => row,
            _ => table.row(ray.observer)?,
        };
        let bend = row.bend(ray.at);
        self.row = Some(row);
        Ok(bend)
    }
}

fn number(word: &str) -> Result<f64, QuestionError> {
    word.parse()
        .map_err(|_| QuestionError::Number(excerpt(word)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_tables::default_atlas;

    #[test]
    fn blank_lines_and_comments_ask_nothing() {
        for line in ["", "  \t", "# 10 30", "  #", "\r"] {
            assert_eq!(Question::parse(line.as_bytes()), Ok(None), "{line:?}");
        }
        assert!(Question::parse(b"10 30\r").unwrap().is_some());
    }

    #[test]
    fn a_bad_line_is_explained_in_a_short_one() {
        let long = "x".repeat(1000);
        for (line, word) in [
            ("10", "R THETA_DEG"),
            ("10 20 30", "R THETA_DEG"),
            (long.as_str(), "xxx..."),
            ("ten 30", "'ten' is not a number"),
            ("10 \u{1b}[2J", "\\u{1b}[2J"),
            ("10 181", "181"),
            ("10 NaN", "NaN"),
            ("NaN 10", "NaN"),
            ("inf -1", "-1"),
            ("1e200 1", "1e150"),
        ] {
            let told = Question::parse(line.as_bytes()).unwrap_err().to_string();
            assert!(told.contains(word), "{line:?}: {told}");
            assert!(told.len() < 160, "{told}");
        }
        let endless = vec![b' '; MAX_LINE + 1];
        assert_eq!(Question::parse(&endless), Err(QuestionError::TooLong));
        assert_eq!(Question::parse(b"\xff 1"), Err(QuestionError::NotText));
    }

    #[test]
    fn any_pair_of_numbers_is_answered_or_refused() {
        let special = [
            0.0,
            -0.0,
            1.0,
            1.0 + f64::EPSILON,
            1.5,
            2.6,
            180.0,
            1e-308,
            5e-324,
            1e-150,
            1e150,
            1e151,
            f64::MAX,
            f64::INFINITY,
            f64::NAN,
            -3.0,
        ];
        let mut rng = fastrand::Rng::with_seed(3);
        let mut any = || f64::from_bits(rng.u64(..));
        let random: Vec<(f64, f64)> = (0..20_000).map(|_| (any().abs(), any().abs())).collect();
        let pairs = special
            .iter()
            .flat_map(|&r| special.map(|second| (r, second)));
        let mut answered = 0;
        for (r, second) in pairs.chain(random) {
            let Ok(question) = Question::new(r, second) else {
                continue;
            };
            for method in [
                QueryMethod::Lookup(default_atlas()),
                QueryMethod::Rk4(1e-9),
                QueryMethod::Exact,
            ] {
                let bend = Answers::new(method).answer(&question).unwrap();
                let said = bend.escaped().unwrap_or(0.0);
                assert!(said.is_finite(), "{r:e} {second:e} {method:?}: {said}");
                answered += 1;
            }
        }
        assert!(answered > 5000, "{answered}");
    }
}
