//! The regimes and the true outcome of each, computed by `docs/stability/reference.py`: the closed form to 60
//! digits, from exactly the f64 numbers that the methods get.

use crate::methods::InitialConditions;
use lensbake_core::{Observer, ShadowCoordinate};
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
    /// Group and name in one string.
    pub fn title(&self) -> String {
        format!("{}: {}", self.group, self.name)
    }
}

impl Input {
    /// The observer. If none exists at that radius, one at a finite radius takes its place, so that the methods
    /// that serve finite observers are tried.
    pub fn observer(self) -> Observer {
        let stand_in = || Observer::at(10.0).unwrap_or(Observer::at_infinity());
        match self {
            Input::FromInfinity(_) => Observer::at_infinity(),
            Input::AtEdge { r, .. } | Input::View { r, .. } => {
                Observer::at(r).unwrap_or_else(|_| stand_in())
            }
        }
    }

    /// The initial conditions for this input.
    pub fn initial(self) -> InitialConditions {
        match self {
            Input::FromInfinity(b) => InitialConditions::from_infinity(b),
            Input::AtEdge { gap, .. } => InitialConditions::of(&ObservedRay {
                observer: self.observer(),
                at: ShadowCoordinate {
                    x: 1.0 - gap,
                    one_minus_x: gap,
                },
            }),
            Input::View { r, theta } => InitialConditions::from_view(r, theta),
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
