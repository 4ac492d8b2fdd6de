//! The methods that the chart compares.

use super::ChartError;
use lensbake_core::{Motion, MovingFrame};
use lensbake_render::camera::{Camera, CameraError, View};
use lensbake_render::gpu::Pass;
use lensbake_render::lens::{Deflection, Lens, LensError, Lookup};
use lensbake_render::model::Model;
use lensbake_render::scene::Sampling;
use lensbake_tables::lookup::GpuRow;
use lensbake_tables::{ChannelRanges, Interpolation, RowFormat, Table};

/// A family of methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Rows with cubic Hermite interpolation; the default row is one of them.
    Hermite,
    /// The default row in other formats.
    Format,
    /// Rows with linear interpolation.
    Linear,
    /// RK4 along every ray.
    Direct,
    /// No deflection: the lower bound of the cost.
    Flat,
    /// The default row for a camera in free fall.
    Falling,
    /// The default row, drawn in another kind of pass or with the mean over each pixel.
    Drawing,
}

impl Family {
    /// All families, in the legend's order.
    pub const ALL: [Family; 7] = [
        Family::Hermite,
        Family::Format,
        Family::Linear,
        Family::Direct,
        Family::Flat,
        Family::Falling,
        Family::Drawing,
    ];

    /// Name in the legend and the CSV file.
    pub fn name(self) -> &'static str {
        match self {
            Family::Hermite => "row, Hermite",
            Family::Format => "row, other formats",
            Family::Linear => "row, linear",
            Family::Direct => "direct RK4, f32",
            Family::Flat => "undeflected",
            Family::Falling => "in free fall",
            Family::Drawing => "other passes and filters",
        }
    }
}

/// A method to measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Contender {
    /// Name within its family: its number of texels, its format or its step.
    pub name: String,
    /// Family of methods.
    pub family: Family,
    /// The lens that uses the method.
    pub lens: Lens,
    /// How a pixel samples its area.
    pub sampling: Sampling,
    /// The kind of pass that draws it; `None` for that of the renderer.
    pub pass: Option<Pass>,
}

impl Contender {
    /// A method that is drawn by one ray per pixel, in the renderer's kind of pass.
    fn new(name: impl Into<String>, family: Family, lens: Lens) -> Self {
        Contender {
            name: name.into(),
            family,
            lens,
            sampling: Sampling::Single,
            pass: None,
        }
    }
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
        Ok(Contender::new(name, family, model.lens(lens)?))
    };
    ladder
        .into_iter()
        .chain(finer)
        .chain(direct)
        .map(contender)
        .collect()
}

/// `lens`, whose row must be the table's, with the row in other formats: in 16-bit integers only if the device has them
/// (`unorm16`).
pub fn formats(lens: &Lens, unorm16: bool) -> Vec<Contender> {
    let ranges = ChannelRanges::of(&GpuRow::new(&lens.row).texels);
    let unorm16 = unorm16.then_some(("16-bit integers", RowFormat::Unorm16(ranges)));
    [("half floats", RowFormat::Float16)]
        .into_iter()
        .chain(unorm16)
        .chain([("coefficients", RowFormat::Coefficients)])
        .map(|(name, format)| {
            let lens = Lens {
                row: lens.row.clone().in_format(format),
                lookup: Lookup::Row,
                ..lens.with_deflection(Deflection::Lut)
            };
            (name, lens)
        })
        .chain([("stereographic", lens.with_deflection(Deflection::Lut))])
        .map(|(name, lens)| Contender::new(name, Family::Format, lens))
        .collect()
}

/// `lens`, whose row must be the table's, drawn in a render pass, and with the mean over each pixel in either kind of pass.
/// The rays are those of the table; only the time differs.
pub fn drawings(lens: &Lens) -> Vec<Contender> {
    use Sampling::{Anisotropic, Filtered, Single};
    [
        ("one ray, render pass", Single, Pass::Fragment),
        ("filtered, compute pass", Filtered, Pass::Compute),
        ("filtered, render pass", Filtered, Pass::Fragment),
        ("anisotropic, compute pass", Anisotropic, Pass::Compute),
        ("anisotropic, render pass", Anisotropic, Pass::Fragment),
    ]
    .map(|(name, sampling, pass)| Contender {
        sampling,
        pass: Some(pass),
        ..Contender::new(name, Family::Drawing, lens.with_deflection(Deflection::Lut))
    })
    .into()
}

/// The ways to draw the view of a camera in free fall: by the row for its frame, or by the row of the observer at rest
/// (at the horizon and below, in free fall) with a boost in the shader. Below the horizon there is only the first.
///
/// # Errors
/// [`ChartError`] if nobody can fall at the view's radius, or `table` has no row there.
pub fn falling(view: &View, table: &Table) -> Result<Vec<Contender>, ChartError> {
    let frame = MovingFrame::new(view.radius, Motion::Fall).map_err(CameraError::Radius)?;
    let boosted = frame.as_boost();
    let mut frames = vec![("row for the frame", frame)];
    frames.extend((boosted != frame).then_some(("boost in the shader", boosted)));
    frames
        .into_iter()
        .map(|(name, frame)| {
            let camera = Camera::in_frame(&frame, view)?;
            let lens = Lens::new(camera, table, Deflection::Lut)?;
            Ok(Contender::new(name, Family::Falling, lens))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_render::model::Cost;
    use lensbake_tables::default_atlas;

    #[test]
    fn the_formats_differ_in_bytes_and_loads() {
        let camera = Camera::new(&View::default()).unwrap();
        let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
        let floats = Lens {
            lookup: Lookup::Row,
            ..lens.clone()
        };
        let usual = Cost::of(&floats).bytes;
        let costs: Vec<_> = formats(&lens, true)
            .iter()
            .map(|contender| Cost::of(&contender.lens))
            .map(|cost| (cost.bytes as i64 - usual as i64, cost.loads))
            .collect();
        assert_eq!(costs, [(-256, 2), (-256, 2), (512, 1), (46_592, 1)]);
        assert_eq!(formats(&lens, false).len(), 3);
    }
}
