//! The methods that the chart compares.

use lensbake_render::lens::{Lens, LensError};
use lensbake_render::model::Model;
use lensbake_tables::Interpolation;

/// A family of methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Rows with cubic Hermite interpolation; the default row is one of them.
    Hermite,
    /// Rows with linear interpolation.
    Linear,
    /// RK4 along every ray.
    Direct,
    /// No deflection: the lower bound of the cost.
    Flat,
}

impl Family {
    /// All families, in the legend's order.
    pub const ALL: [Family; 4] = [
        Family::Hermite,
        Family::Linear,
        Family::Direct,
        Family::Flat,
    ];

    /// Name in the legend and the CSV file.
    pub fn name(self) -> &'static str {
        match self {
            Family::Hermite => "row, Hermite",
            Family::Linear => "row, linear",
            Family::Direct => "direct RK4, f32",
            Family::Flat => "undeflected",
        }
    }
}

/// A method to measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Contender {
    /// Name within its family: its number of texels or its step.
    pub name: String,
    /// Family of methods.
    pub family: Family,
    /// The lens that uses the method.
    pub lens: Lens,
}

/// Texel counts above the table's that linear rows need for an error near the table's.
const FINER: [u32; 2] = [256, 1024];
/// Steps of direct integration, rad.
const STEPS: [f64; 6] = [0.4, 0.2, 0.1, 0.05, 0.025, 0.0125];

/// All contenders for `lens`, whose row must be the table's.
///
/// # Errors
/// Those of [`Model::lens`]; none occurs for the row of a valid table.
pub fn contenders(lens: &Lens) -> Result<Vec<Contender>, LensError> {
    let finer = FINER.map(|texels| Model::Row {
        texels,
        interpolation: Interpolation::Linear,
    });
    let direct = STEPS.map(|step| Model::Direct { step });
    let ladder = Model::ladder(lens.row.texel_count());
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
            lens: model.lens(lens)?,
        })
    };
    ladder
        .into_iter()
        .chain(finer)
        .chain(direct)
        .map(contender)
        .collect()
}
