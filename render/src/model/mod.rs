//! Model selection: the cheapest model of the bending that is accurate enough for a picture.
//!
//! The accuracy needed depends on the camera's radius, its pixel spacing and the part of the table's axis that its
//! pixels see: far from the hole and looking away, no bending is visible; looking at the hole, a row of 8 texels is
//! often enough. The models are tried from the cheapest on. Each is compared with the closed form in image
//! space, and the first within the error budget is chosen.

mod cost;
mod disc;
mod explain;
mod prediction;
mod samples;

pub use cost::Cost;
pub use explain::explain;
pub use prediction::{Precision, Prediction};

use crate::disc::Disc;
use crate::lens::{Deflection, Lens, LensError, Lookup};
use disc::{DiscReference, integrated};
use lensbake_tables::Interpolation;
use prediction::Predictor;
use std::fmt;

/// Default error budget in image space: a tenth of a pixel, which is too small to see.
pub const DEFAULT_BUDGET_PX: f64 = 0.1;

/// Number of texels of the shortest row that is tried.
const FEWEST_TEXELS: u32 = 4;

/// A model of the bending in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// No deflection: the undeflected sky behind the horizon as a plain sphere.
    Flat,
    /// One row, resampled from the table's.
    Row {
        /// Number of texels.
        texels: u32,
        /// Interpolation between texels.
        interpolation: Interpolation,
    },
    /// Direct integration. Never chosen: drawn only when asked for.
    Direct {
        /// The step, rad.
        step: f64,
    },
}

impl Model {
    /// The models to choose from, cheapest first, if the table's row has `most` texels: fewer texels before more,
    /// and linear before Hermite. The rows are then also in order of their bytes.
    pub fn ladder(most: u32) -> Vec<Model> {
        let thinned = std::iter::successors(Some(FEWEST_TEXELS), |n| n.checked_mul(2));
        let counts = thinned.take_while(|&n| n < most).chain([most]);
        let rows = counts.flat_map(|texels| {
            [Interpolation::Linear, Interpolation::Hermite].map(|interpolation| Model::Row {
                texels,
                interpolation,
            })
        });
        [Model::Flat].into_iter().chain(rows).collect()
    }

    /// The lens that draws `lens` by this model. The row of `lens` must be the table's, not resampled.
    ///
    /// # Errors
    /// [`LensError`] if no row can have so many texels, or the step is out of range.
    pub fn lens(self, lens: &Lens) -> Result<Lens, LensError> {
        match self {
            Model::Flat => Ok(lens.with_deflection(Deflection::Flat)),
            Model::Direct { step } => {
                Deflection::check_step(step)?;
                Ok(lens.with_deflection(Deflection::Direct { step }))
            }
            Model::Row {
                texels,
                interpolation,
            } => Ok(Lens {
                row: lens.row.resampled(texels, interpolation)?,
                lookup: Lookup::Row,
                ..lens.with_deflection(Deflection::Lut)
            }),
        }
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Model::Flat => f.pad("flat"),
            Model::Row {
                texels,
                interpolation,
            } => f.pad(&format!("row of {texels}, {}", interpolation.name())),
            Model::Direct { step } => f.pad(&format!("direct, {step} rad")),
        }
    }
}

/// A model that was tried, with its lens and its predicted error.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The model.
    pub model: Model,
    /// The lens that draws by this model.
    pub lens: Lens,
    /// Its predicted error in this picture.
    pub prediction: Prediction,
}

/// The result of [`choose`]: the cheapest model for a lens, and the other models.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The image-space error allowed, pixels.
    pub budget_px: f64,
    /// The precision that the picture is drawn in.
    pub precision: Precision,
    /// Largest error by rounding alone, pixels; part of every prediction.
    pub rounding_px: f64,
    /// Number of sample pixels of the predictions.
    pub samples: usize,
    /// Number of those that show the disc; `None` without one.
    pub samples_of_disc: Option<usize>,
    /// The first model within the budget; `None` if even the whole row exceeds it.
    pub chosen: Option<Candidate>,
    /// The cheaper models, which exceed the budget, cheapest first.
    pub left_out: Vec<Candidate>,
    /// The more expensive models, which were not tried.
    pub not_needed: Vec<Model>,
}

/// Chooses the cheapest model of `lens`, whose row must be the table's, with an error of at most `budget_px`
/// pixels in image space, of the sky and of `disc` if there is one, when drawn in `precision`. Takes about ten milliseconds;
/// the result is deterministic.
///
/// # Errors
/// [`LensError`] as [`Model::lens`], which no row of a valid table causes.
pub fn choose(
    lens: &Lens,
    disc: Option<Disc>,
    budget_px: f64,
    precision: Precision,
) -> Result<Choice, LensError> {
    let integrated = integrated(lens);
    let disc = disc.map(|disc| DiscReference::new(lens, &integrated, disc));
    let predictor = Predictor::new(lens, disc, precision);
    let mut models = Model::ladder(lens.row.texel_count()).into_iter();
    let (mut chosen, mut left_out) = (None, Vec::new());
    for model in models.by_ref() {
        let lens = model.lens(lens)?;
        let candidate = Candidate {
            model,
            prediction: predictor.predict(&lens),
            lens,
        };
        if candidate.prediction.pixels <= budget_px {
            chosen = Some(candidate);
            break;
        }
        left_out.push(candidate);
    }
    Ok(Choice {
        budget_px,
        precision,
        rounding_px: predictor.rounding_px(),
        samples: predictor.samples(),
        samples_of_disc: predictor.samples_of_disc(),
        chosen,
        left_out,
        not_needed: models.collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use lensbake_tables::default_atlas;

    fn lens(view: View) -> Lens {
        Lens::new(
            Camera::new(&view).unwrap(),
            default_atlas(),
            Deflection::Lut,
        )
        .unwrap()
    }

    #[test]
    fn the_ladder_climbs_in_bytes() {
        let lens = lens(View::default());
        let ladder = Model::ladder(64);
        assert_eq!(ladder.len(), 11);
        let bytes: Vec<_> = ladder
            .iter()
            .map(|m| Cost::of(&m.lens(&lens).unwrap()).bytes)
            .collect();
        assert!(bytes.is_sorted(), "{bytes:?}");
    }

    #[test]
    fn a_row_of_any_length_ends_the_ladder() {
        let last = |most| *Model::ladder(most).last().unwrap();
        for most in [4, 5, 64, 100] {
            let expected = Model::Row {
                texels: most,
                interpolation: Interpolation::Hermite,
            };
            assert_eq!(last(most), expected);
        }
    }

    #[test]
    fn far_away_and_looking_away_nothing_is_needed() {
        let view = View {
            radius: 1e5,
            yaw_deg: 180.0,
            width: 64,
            height: 36,
            ..View::default()
        };
        let choice = choose(&lens(view), None, DEFAULT_BUDGET_PX, Precision::F64).unwrap();
        assert_eq!(choice.chosen.unwrap().model, Model::Flat);
        assert_eq!((choice.left_out.len(), choice.not_needed.len()), (0, 10));
    }

    #[test]
    fn a_budget_below_the_tables_own_error_is_met_by_nothing() {
        let choice = choose(&lens(View::default()), None, 1e-9, Precision::F64).unwrap();
        assert_eq!(choice.chosen, None);
        assert_eq!(choice.left_out.len(), 11);
    }

    #[test]
    fn a_step_that_makes_no_sense_is_refused() {
        let model = Model::Direct { step: 7.0 };
        assert!(model.lens(&lens(View::default())).is_err());
    }
}
