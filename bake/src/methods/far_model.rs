//! The observer taken to be at infinity: exact bending for the wrong observer.
//!
//! A camera at o looking along the unit vector d is given the ray from infinity with b = |o × d|, as
//! bholetrace and others do. Beside the bending that the ray has not met yet, it leaves out the
//! observer's clock, and bends what lies behind him as much as what lies before.

use super::{Card, Family, Launch, Method, Outcome};
use lensbake_core::{Observer, Ray, exact};

/// Δφ(|o × d|) in closed form, for a static observer at finite radius.
#[derive(Debug, Clone, Copy)]
pub struct FarModel;

impl Method for FarModel {
    fn card(&self) -> Card {
        Card {
            name: "observer put at infinity".to_owned(),
            knobs: "b = |o × d|".to_owned(),
            source: "bholetrace",
            family: Family::Model,
            landmark: true,
        }
    }

    fn serves(&self, observer: &Observer) -> bool {
        !observer.is_far()
    }

    fn bend(&self, launch: &Launch) -> Outcome {
        let b = launch.theta.sin() / launch.u;
        match Ray::from_infinity(b) {
            Ok(ray) => exact::bend(&ray).into(),
            Err(error) => Outcome::Refused(error),
        }
    }
}
