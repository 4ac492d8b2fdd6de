//! Questions about single rays, as lines of text, and their answers.

mod crossings;

use lensbake_core::rk4::Stepper;
use lensbake_core::{
    CoreError, Motion, MovingFrame, Ray, RayOutcome, ShadowCoordinate, direct, exact,
};
use lensbake_tables::baking::ObservedRay;
use lensbake_tables::text::excerpt;
use lensbake_tables::{Row, Table, TableError};
use thiserror::Error;

/// Longest line that can be a question, bytes.
pub const MAX_LINE: usize = 4096;

/// A question about one ray: the observer and where he looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Question {
    /// The observer in radial motion who sees the ray, and its normalised shadow coordinate.
    pub observed: ObservedRay,
    /// The ray, followed backwards from the observer.
    pub ray: Ray,
    /// View angle from the direction of the hole in the frame of the observer who asks, rad; 0 for the observer at
    /// infinity.
    theta: f64,
    /// View angle of the same ray in the frame of [`Question::observed`], rad; 0 for the observer at infinity.
    observed_theta: f64,
    /// Azimuth of the ray's plane about the direction of the hole, from the direction of motion, rad.
    azimuth: f64,
    /// ν_obs/ν_∞ if the ray escapes.
    shift: f64,
}

/// Where the light of a ray comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkyPoint {
    /// θ_sky = π − φ, the angle from the direction of the hole, with φ the orbital angle from the outward direction to
    /// the sky. It is not reduced to [0, π]: light that has gone round the hole has θ_sky < 0. rad.
    pub theta: f64,
    /// Azimuth about the direction of the hole, from the direction of motion, rad.
    pub azimuth: f64,
    /// Frequency shift ν_obs/ν_∞.
    pub shift: f64,
    /// View angle minus θ_sky, rad: the bending (deflection angle).
    pub bend: f64,
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
    /// The line does not have two or three words.
    #[error("'{0}' is not `R THETA_DEG [AZIMUTH_DEG]` or `inf B [AZIMUTH_DEG]`")]
    Form(String),
    /// A word is not a number.
    #[error("'{0}' is not a number")]
    Number(String),
    /// The view angle is out of range.
    #[error("view angle {0} is outside 0 to 180 degrees")]
    ViewAngle(f64),
    /// The azimuth is not finite.
    #[error("azimuth {0} is not a number of degrees")]
    Azimuth(f64),
    /// The ray does not exist.
    #[error(transparent)]
    Ray(#[from] CoreError),
}

impl Question {
    /// Parses a line `R THETA_DEG [AZIMUTH_DEG]` (the radius in units of r_s, the view angle from the direction of the
    /// hole, and the azimuth about it from the direction of motion, in degrees) or `inf B [AZIMUTH_DEG]` (the impact
    /// parameter in units of r_s), for an observer in this motion. `None` for a blank line and for a comment, which begins with `#`.
    ///
    /// # Errors
    /// [`QuestionError`] says in one short line what is wrong.
    pub fn parse(line: &[u8], motion: Motion) -> Result<Option<Self>, QuestionError> {
        if line.len() > MAX_LINE {
            return Err(QuestionError::TooLong);
        }
        let line = std::str::from_utf8(line).map_err(|_| QuestionError::NotText)?;
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            return Ok(None);
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        let (r, second, azimuth) = match words[..] {
            [r, second] => (r, second, "0"),
            [r, second, azimuth] => (r, second, azimuth),
            _ => return Err(QuestionError::Form(excerpt(line))),
        };
        Question::new(motion, number(r)?, number(second)?, number(azimuth)?).map(Some)
    }

    /// The question for the observer at radius `r` in this motion, and the view angle `second` and `azimuth` in
    /// degrees; for the observer at infinity `second` is the impact parameter.
    fn new(motion: Motion, r: f64, second: f64, azimuth: f64) -> Result<Self, QuestionError> {
        let frame = MovingFrame::new(r, motion)?;
        if !azimuth.is_finite() {
            return Err(QuestionError::Azimuth(azimuth));
        }
        let azimuth = azimuth.to_radians();
        let observer = *frame.observer();
        if observer.is_at_infinity() {
            return Ok(Question {
                ray: Ray::from_infinity(second)?,
                observed: ObservedRay {
                    observer,
                    at: ShadowCoordinate::from_b(second),
                },
                theta: 0.0,
                observed_theta: 0.0,
                azimuth,
                shift: 1.0,
            });
        }
        if !(0.0..=180.0).contains(&second) {
            return Err(QuestionError::ViewAngle(second));
        }
        let theta = second.to_radians();
        let seen = frame.unboosted(theta, azimuth);
        Ok(Question {
            ray: observer.ray(seen.theta)?,
            observed: ObservedRay {
                observer,
                at: observer.shadow_coordinate(seen.theta),
            },
            theta,
            observed_theta: seen.theta,
            azimuth: seen.azimuth,
            shift: frame.frequency_shift(theta, azimuth),
        })
    }

    /// Where the light comes from, if the bending in the frame of [`Question::observed`] is `bend`.
    fn sky_point(&self, bend: f64) -> SkyPoint {
        SkyPoint {
            theta: self.observed_theta - bend,
            azimuth: self.azimuth,
            shift: self.shift,
            bend: bend + (self.theta - self.observed_theta),
        }
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

    /// The outcome of the ray, with where its light comes from.
    ///
    /// # Errors
    /// [`TableError`] if the table holds another observer's row, or its axis does not reach the ray.
    pub fn answer(&mut self, question: &Question) -> Result<RayOutcome<SkyPoint>, TableError> {
        let bend = match self.method {
            QueryMethod::Lookup(table) => self.look_up(table, question.observed)?,
            QueryMethod::Rk4(tolerance) => {
                direct::bend(&question.ray, Stepper::Adaptive(tolerance))
            }
            QueryMethod::Exact => exact::bend(&question.ray),
        };
        Ok(bend.map(|bend| question.sky_point(bend)))
    }

    /// The bending by the row of the observer's row frame.
    fn look_up(&mut self, table: &Table, ray: ObservedRay) -> Result<RayOutcome, TableError> {
        table.header().axis.check_reach(ray.at)?;
        let row_frame = ray.observer.in_row_frame();
        let row = match self.row.take() {
            Some(row) if *row.observer() == row_frame => row,
            _ => table.row(row_frame)?,
        };
        let bend = row.bend_for(&ray.observer, ray.at);
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
    use lensbake_core::ThinDisc;
    use lensbake_core::thin_disc::MAX_OUTER;
    use lensbake_tables::default_atlas;

    #[test]
    fn blank_lines_and_comments_ask_nothing() {
        for line in ["", "  \t", "# 10 30", "  #", "\r"] {
            assert_eq!(
                Question::parse(line.as_bytes(), Motion::Rest),
                Ok(None),
                "{line:?}"
            );
        }
        assert!(Question::parse(b"10 30\r", Motion::Rest).unwrap().is_some());
    }

    #[test]
    fn a_bad_line_is_explained_in_a_short_one() {
        let long = "x".repeat(1000);
        for (line, word) in [
            ("10", "R THETA_DEG"),
            ("10 20 30 40", "R THETA_DEG"),
            ("10 20 NaN", "azimuth"),
            (long.as_str(), "xxx..."),
            ("ten 30", "'ten' is not a number"),
            ("10 \u{1b}[2J", "\\u{1b}[2J"),
            ("10 181", "181"),
            ("10 NaN", "NaN"),
            ("NaN 10", "NaN"),
            ("inf -1", "-1"),
            ("1e200 1", "1e150"),
        ] {
            let told = Question::parse(line.as_bytes(), Motion::Rest)
                .unwrap_err()
                .to_string();
            assert!(told.contains(word), "{line:?}: {told}");
            assert!(told.len() < 160, "{told}");
        }
        let endless = vec![b' '; MAX_LINE + 1];
        assert_eq!(
            Question::parse(&endless, Motion::Rest),
            Err(QuestionError::TooLong)
        );
        assert_eq!(
            Question::parse(b"\xff 1", Motion::Rest),
            Err(QuestionError::NotText)
        );
    }

    const MOTIONS: [Motion; 5] = [
        Motion::Rest,
        Motion::Fall,
        Motion::Orbit,
        Motion::Velocity {
            radial: -0.6,
            tangential: 0.7999,
        },
        Motion::Velocity {
            radial: 0.9,
            tangential: 0.0,
        },
    ];

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
        let disc = ThinDisc::new(3.0, MAX_OUTER, 80.0, 0.0).unwrap();
        let mut answered = 0;
        for (r, second) in pairs.chain(random) {
            for motion in MOTIONS {
                let Ok(question) = Question::new(motion, r, second, second) else {
                    continue;
                };
                if question.observed.observer.inverse_radius() > 100.0 {
                    continue;
                }
                for method in [
                    QueryMethod::Lookup(default_atlas()),
                    QueryMethod::Rk4(1e-9),
                    QueryMethod::Exact,
                ] {
                    let mut answers = Answers::new(method);
                    for crossing in answers.crossings(&question, &disc).unwrap() {
                        let said = [crossing.radius, crossing.shift];
                        assert!(
                            said.iter().all(|x| x.is_finite() && *x > 0.0),
                            "{motion:?} {r:e} {second:e} {method:?}: {crossing:?}"
                        );
                    }
                    let sky = answers.answer(&question).unwrap().escaped();
                    if let Some(SkyPoint {
                        theta,
                        azimuth,
                        shift,
                        bend,
                    }) = sky
                    {
                        let said = [theta, azimuth, shift, bend];
                        assert!(
                            said.iter().all(|x| x.is_finite()),
                            "{motion:?} {r:e} {second:e} {method:?}: {said:?}"
                        );
                        assert!(shift > 0.0, "{motion:?} {r:e} {second:e}: {shift}");
                    }
                    answered += 1;
                }
            }
        }
        assert!(answered > 5000, "{answered}");
    }
}
