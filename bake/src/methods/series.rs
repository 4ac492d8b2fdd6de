//! The weak and the strong limit, each used everywhere.

use super::{Card, Family, Launch, Method, Outcome};
use lensbake_core::{B_CRIT, Observer, series};

/// Four terms in 1/b.
#[derive(Debug, Clone, Copy)]
pub struct WeakSeries;

impl Method for WeakSeries {
    fn card(&self) -> Card {
        Card {
            name: "weak series".to_owned(),
            knobs: "4 terms".to_owned(),
            source: "Keeton & Petters 2005",
            family: Family::Closed,
            landmark: true,
        }
    }

    fn serves(&self, observer: &Observer) -> bool {
        observer.is_far()
    }

    /// The series itself knows no capture; the shadow is put in by hand.
    fn bend(&self, launch: &Launch) -> Outcome {
        if launch.b <= B_CRIT {
            return Outcome::Captured;
        }
        Outcome::Escapes(series::weak(launch.b))
    }
}

/// The logarithm at the edge.
#[derive(Debug, Clone, Copy)]
pub struct StrongLimit;

impl Method for StrongLimit {
    fn card(&self) -> Card {
        Card {
            name: "strong limit".to_owned(),
            knobs: String::new(),
            source: "Bozza 2002",
            family: Family::Closed,
            landmark: true,
        }
    }

    fn serves(&self, observer: &Observer) -> bool {
        observer.is_far()
    }

    fn bend(&self, launch: &Launch) -> Outcome {
        if launch.b <= B_CRIT {
            return Outcome::Captured;
        }
        Outcome::Escapes(series::strong(launch.b))
    }
}
