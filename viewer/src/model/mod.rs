//! The least model of the bending that a picture needs.
//!
//! What a scene asks for depends on where its camera stands, how far its pixels are apart and which
//! part of the axis they see: far from the hole and looking away no bending shows at all; at the hole a
//! row of 8 texels often will do. The models are tried from the cheapest on, each held to the closed
//! form in image space, and the first within the budget is taken.

mod cost;
mod explain;
mod prediction;
mod samples;

pub use cost::Cost;
pub use explain::explain;
pub use prediction::{Precision, Prediction};

use crate::scene::{Method, Scene, SceneError};
use lensbake_tables::Interpolation;
use prediction::Predictor;
use std::fmt;

/// The image-space error that nobody sees: a tenth of a pixel.
pub const DEFAULT_BUDGET_PX: f64 = 0.1;

/// The fewest texels of a row that are tried.
const FEWEST_TEXELS: u32 = 4;

/// How the bending of a picture is had.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// Not at all: the undeflected sky before the horizon as a plain sphere.
    Flat,
    /// From one row, resampled from the table's.
    Row {
        /// Its texels.
        texels: u32,
        /// How it is read between them.
        interpolation: Interpolation,
    },
    /// By direct integration. Never chosen: only drawn when asked for.
    Direct {
        /// The step, rad.
        step: f64,
    },
}

impl Model {
    /// The models that may be chosen when the table's row has `most` texels, from the least on: fewer
    /// texels before more, linear before Hermite, which is also the order of their bytes.
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

    /// `scene`, whose row is the table's, drawn by this model.
    ///
    /// # Errors
    /// [`SceneError`] if no row can have so many texels, or the step makes no sense.
    pub fn scene(self, scene: &Scene) -> Result<Scene, SceneError> {
        match self {
            Model::Flat => Ok(scene.by(Method::Flat)),
            Model::Direct { step } => {
                Method::check_step(step)?;
                Ok(scene.by(Method::Direct { step }))
            }
            Model::Row {
                texels,
                interpolation,
            } => Ok(Scene {
                row: scene.row.resampled(texels, interpolation)?,
                ..scene.by(Method::Lut)
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

/// A model that was tried, drawn ready, with what it would be off by.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The model.
    pub model: Model,
    /// The scene drawn by it.
    pub scene: Scene,
    /// Its error in this picture.
    pub prediction: Prediction,
}

/// The least model of a scene, and those that were tried before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The image-space error allowed, pixels.
    pub budget_px: f64,
    /// The numbers that the picture is drawn in.
    pub precision: Precision,
    /// What its rounding may come to by itself, pixels; part of every prediction.
    pub rounding_px: f64,
    /// Pixels that the predictions were first made from.
    pub samples: usize,
    /// The first model within the budget; `None` if not even the whole row is.
    pub chosen: Option<Candidate>,
    /// The cheaper models, which are not, cheapest first.
    pub left_out: Vec<Candidate>,
    /// The dearer models, which were not tried.
    pub not_needed: Vec<Model>,
}

/// Chooses the least model of `scene`, whose row is the table's, with an error of at most `budget_px`
/// pixels in image space when drawn in `precision`. Takes some ten milliseconds and always finds the
/// same.
///
/// # Errors
/// [`SceneError`] as [`Model::scene`], which no row of a valid table brings about.
pub fn choose(scene: &Scene, budget_px: f64, precision: Precision) -> Result<Choice, SceneError> {
    let predictor = Predictor::new(scene, precision);
    let mut models = Model::ladder(scene.row.texel_count()).into_iter();
    let (mut chosen, mut left_out) = (None, Vec::new());
    for model in models.by_ref() {
        let scene = model.scene(scene)?;
        let candidate = Candidate {
            model,
            prediction: predictor.predict(&scene),
            scene,
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

    fn scene(view: View) -> Scene {
        Scene::new(Camera::new(&view).unwrap(), default_atlas(), Method::Lut).unwrap()
    }

    #[test]
    fn the_ladder_climbs_in_bytes() {
        let scene = scene(View::default());
        let ladder = Model::ladder(64);
        assert_eq!(ladder.len(), 11);
        let bytes: Vec<_> = ladder
            .iter()
            .map(|m| Cost::of(&m.scene(&scene).unwrap()).bytes)
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
        let choice = choose(&scene(view), DEFAULT_BUDGET_PX, Precision::F64).unwrap();
        assert_eq!(choice.chosen.unwrap().model, Model::Flat);
        assert_eq!((choice.left_out.len(), choice.not_needed.len()), (0, 10));
    }

    #[test]
    fn a_budget_below_the_tables_own_error_is_met_by_nothing() {
        let choice = choose(&scene(View::default()), 1e-9, Precision::F64).unwrap();
        assert_eq!(choice.chosen, None);
        assert_eq!(choice.left_out.len(), 11);
    }

    #[test]
    fn a_step_that_makes_no_sense_is_refused() {
        let model = Model::Direct { step: 7.0 };
        assert!(model.scene(&scene(View::default())).is_err());
    }
}
