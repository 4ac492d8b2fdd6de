//! Who takes part.

use crate::model::Model;
use crate::scene::{Scene, SceneError};
use lensbake_tables::Interpolation;

/// What a method belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Rows read by cubics; the product's own is one of them.
    Hermite,
    /// Rows read along chords.
    Linear,
    /// RK4 along every ray.
    Direct,
    /// Nobody turns the light: the floor of the cost.
    Flat,
}

impl Family {
    /// All of them, in the legend's order.
    pub const ALL: [Family; 4] = [
        Family::Hermite,
        Family::Linear,
        Family::Direct,
        Family::Flat,
    ];

    /// Its name in the legend and the data.
    pub fn name(self) -> &'static str {
        match self {
            Family::Hermite => "row, Hermite",
            Family::Linear => "row, linear",
            Family::Direct => "direct RK4, f32",
            Family::Flat => "undeflected",
        }
    }
}

/// A method that takes part.
#[derive(Debug, Clone, PartialEq)]
pub struct Contender {
    /// What it is called within its family: its texels or its step.
    pub name: String,
    /// Its family.
    pub family: Family,
    /// The scene drawn by it.
    pub scene: Scene,
}

/// Texel counts beyond the table's that linear rows need to come near it.
const FINER: [u32; 2] = [256, 1024];
/// Steps of direct integration, rad.
const STEPS: [f64; 6] = [0.4, 0.2, 0.1, 0.05, 0.025, 0.0125];

/// All contenders for `scene`, whose row is the table's.
///
/// # Errors
/// [`SceneError`] as [`Model::scene`], which no row of a valid table brings about.
pub fn contenders(scene: &Scene) -> Result<Vec<Contender>, SceneError> {
    let finer = FINER.map(|texels| Model::Row {
        texels,
        interpolation: Interpolation::Linear,
    });
    let direct = STEPS.map(|step| Model::Direct { step });
    let ladder = Model::ladder(scene.row.texel_count());
    let contender = |model: Model| {
        let (name, family) = match model {
            Model::Flat => ("no bending".to_owned(), Family::Flat),
            Model::Direct { step } => (format!("step {step}"), Family::Direct),
            Model::Row {
                texels,
                interpolation,
            } => {
                let family = match interpolation {
                    Interpolation::Linear => Family::Linear,
                    Interpolation::Hermite => Family::Hermite,
                };
                (format!("{texels} texels"), family)
            }
        };
        Ok(Contender {
            name,
            family,
            scene: model.scene(scene)?,
        })
    };
    ladder
        .into_iter()
        .chain(finer)
        .chain(direct)
        .map(contender)
        .collect()
}
