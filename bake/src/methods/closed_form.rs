//! The closed form in elliptic integrals: the project's oracle.

use super::{Card, Family, Launch, Method, Outcome};
use lensbake_core::exact;

/// [`exact::bend`].
#[derive(Debug, Clone, Copy)]
pub struct ClosedForm;

impl Method for ClosedForm {
    fn card(&self) -> Card {
        Card {
            name: "elliptic integral".to_owned(),
            knobs: String::new(),
            source: "Carlson 1991; this project: lensbake_core::exact",
            family: Family::Closed,
            landmark: true,
        }
    }

    fn bend(&self, launch: &Launch) -> Outcome {
        match &launch.ray {
            Ok(ray) => exact::bend(ray).into(),
            Err(error) => Outcome::Refused(*error),
        }
    }
}
