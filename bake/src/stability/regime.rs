//! The regimes, with the truth for each, as `docs/stability/reference.py` computes it: the closed form
//! with 60 digits, from exactly the f64 numbers that the methods get.

use crate::methods::Launch;
use crate::rays::Sight;
use lensbake_core::{EdgeCoordinate, Observer};

const REGIMES: &str = include_str!("../../data/regimes.csv");

/// The numbers that a regime starts from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// The observer at infinity, impact parameter b.
    FromInfinity(f64),
    /// The static observer at r, edge coordinate x = 1 − gap.
    AtEdge {
        /// Radius, ∞ included.
        r: f64,
        /// 1 − x.
        gap: f64,
    },
    /// The static observer at r who looks at θ from the hole.
    View {
        /// Radius.
        r: f64,
        /// View angle, rad.
        theta: f64,
    },
}

/// What is true of a regime's ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Truth {
    /// It escapes with this bending, rad.
    Escapes(f64),
    /// It is captured.
    Captured,
    /// There is no such ray.
    NoRay,
}

/// A regime.
#[derive(Debug, Clone, PartialEq)]
pub struct Regime {
    /// The group it stands in.
    pub group: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Its numbers.
    pub input: Input,
    /// What is true.
    pub truth: Truth,
}

/// All regimes, in the order of the atlas.
pub fn regimes() -> Vec<Regime> {
    REGIMES.lines().skip(1).filter_map(regime).collect()
}

fn regime(line: &'static str) -> Option<Regime> {
    let fields: Vec<&'static str> = line.split(';').collect();
    let [group, name, kind, first, second, truth] = fields[..] else {
        return None;
    };
    let (first, second): (f64, f64) = (first.parse().ok()?, second.parse().ok()?);
    let input = match kind {
        "b" => Input::FromInfinity(first),
        "edge" => Input::AtEdge {
            r: first,
            gap: second,
        },
        "view" => Input::View {
            r: first,
            theta: second,
        },
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

impl Regime {
    /// Group and name in one.
    pub fn title(&self) -> String {
        format!("{}: {}", self.group, self.name)
    }
}

impl Input {
    /// The observer; where there is none at that radius, one at a finite radius stands for him, so that
    /// those methods are asked that serve such observers.
    pub fn observer(self) -> Observer {
        let stand_in = || Observer::at(10.0).unwrap_or(Observer::far());
        match self {
            Input::FromInfinity(_) => Observer::far(),
            Input::AtEdge { r, .. } | Input::View { r, .. } => {
                Observer::at(r).unwrap_or_else(|_| stand_in())
            }
        }
    }

    /// The launch from these numbers.
    pub fn launch(self) -> Launch {
        match self {
            Input::FromInfinity(b) => Launch::from_infinity(b),
            Input::AtEdge { gap, .. } => Launch::of(&Sight {
                observer: self.observer(),
                at: EdgeCoordinate {
                    x: 1.0 - gap,
                    one_minus_x: gap,
                },
            }),
            Input::View { r, theta } => Launch::from_view(r, theta),
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
