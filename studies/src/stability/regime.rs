//! The regimes and the true outcome of each, computed by `docs/stability/reference.py`: the closed form to 60
//! digits, from exactly the f64 numbers that the methods get.

use super::in_motion::{Direction, InMotion};
use super::trial::{Trial, at_edge, at_rest};
use crate::methods::InitialConditions;
use lensbake_core::{Motion, Observer};
use lensbake_tables::baking::ObservedRay;

const REGIMES: &str = include_str!("../../data/regimes.csv");

/// The input of a regime.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// The observer at infinity and the impact parameter b.
    FromInfinity(f64),
    /// The static observer at r and the normalised shadow coordinate x = 1 − gap.
    AtEdge {
        /// Radius; may be ∞.
        r: f64,
        /// 1 − x.
        gap: f64,
    },
    /// The static observer at r and the view angle θ from the direction of the hole.
    View {
        /// Radius.
        r: f64,
        /// View angle, rad.
        theta: f64,
    },
    /// An observer in motion, and a direction.
    InMotion(InMotion),
}

/// The true outcome of a regime's ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Truth {
    /// It escapes with this bending, rad.
    Escapes(f64),
    /// It is captured.
    Captured,
    /// The input is not a ray.
    NoRay,
}

/// An input for the methods, and its true outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Regime {
    /// Its group.
    pub group: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Its input.
    pub input: Input,
    /// Its true outcome.
    pub truth: Truth,
}

/// All regimes, in the order of the atlas.
pub fn regimes() -> Vec<Regime> {
    REGIMES.lines().skip(1).filter_map(regime).collect()
}

fn regime(line: &'static str) -> Option<Regime> {
    let fields: Vec<&'static str> = line.split(';').collect();
    let [group, name, kind, motion, first, second, azimuth, truth] = fields[..] else {
        return None;
    };
    let motion: Motion = motion.parse().ok()?;
    let [first, second, azimuth]: [f64; 3] = parsed([first, second, azimuth])?;
    let in_motion = |direction| {
        Input::InMotion(InMotion {
            motion,
            r: first,
            direction,
        })
    };
    let input = match (kind, motion) {
        ("b", Motion::Rest) => Input::FromInfinity(first),
        ("edge", Motion::Rest) => Input::AtEdge {
            r: first,
            gap: second,
        },
        ("view", Motion::Rest) => Input::View {
            r: first,
            theta: second,
        },
        ("edge", Motion::Fall) => in_motion(Direction::AtEdge { gap: second }),
        ("view", _) => in_motion(Direction::View {
            theta: second,
            azimuth,
        }),
        _ => return None,
    };
    let truth = match truth {
        "captured" => Truth::Captured,
        "none" => Truth::NoRay,
        bend => Truth::Escapes(bend.parse().ok()?),
    };
    Some(Regime {
        group,
        name,
        input,
        truth,
    })
}

fn parsed<const N: usize>(texts: [&str; N]) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = texts.iter().map(|text| text.parse().ok()).collect();
    numbers?.try_into().ok()
}

impl Regime {
    /// Group and name in one string.
    pub fn title(&self) -> String {
        format!("{}: {}", self.group, self.name)
    }

    /// Whether the observer is in motion.
    pub fn is_in_motion(&self) -> bool {
        matches!(self.input, Input::InMotion(_))
    }
}

impl Input {
    /// What the methods get.
    pub fn trial(self) -> Trial {
        let (observer, initial) = match self {
            Input::FromInfinity(b) => {
                let initial = InitialConditions::from_infinity(b);
                (Observer::at_infinity(), initial)
            }
            Input::AtEdge { r, gap } => {
                let observer = at_rest(r);
                let at = at_edge(gap);
                (
                    observer,
                    InitialConditions::of(&ObservedRay { observer, at }),
                )
            }
            Input::View { r, theta } => (at_rest(r), InitialConditions::from_view(r, theta)),
            Input::InMotion(input) => return input.trial(),
        };
        Trial {
            observer,
            initial,
            aberration: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_line_of_the_file_is_a_regime_with_a_title_of_its_own() {
        let regimes = regimes();
        assert_eq!(regimes.len(), REGIMES.lines().count() - 1);
        let titles: BTreeSet<String> = regimes.iter().map(Regime::title).collect();
        assert_eq!(titles.len(), regimes.len());
    }
}
