//! Options of the window, of `render`, `diff` and `catalogue`, and of point stars.

use super::disc::DiscArgs;
use super::projection::ProjectionArgs;
use super::recorded::RecordedOptions;
use super::scene::{MethodName, PassName, SamplingName, SceneArgs, ViewArgs};
use super::values::{Exposure, exposure, size, stars, stops};
use clap::builder::{OsStringValueParser, TypedValueParser};
use clap::{Args, ValueEnum};
use lensbake_render::layers::Layer;
use lensbake_render::sky::SkySource;
use lensbake_render::stars::StarSource;
use std::path::PathBuf;
use thiserror::Error;

/// Default output file of a picture.
pub const PICTURE: &str = "lensed.png";

/// Options of `viewer render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Picture to write: .png (tone-mapped sRGB) or .exr (linear light); - writes a .png to standard output.
    #[arg(short, long, value_name = "FILE", default_value = PICTURE)]
    pub output: PathBuf,
    /// Draw with the least model (the undeflected sky or the shortest row of the table) whose error in image space
    /// is at most this many pixels. Exit code 1 if even the whole row exceeds it.
    #[arg(
        long,
        value_name = "PX",
        conflicts_with = "method",
        allow_negative_numbers = true
    )]
    pub budget_px: Option<f64>,
    /// Print which models keep the error budget (0.1 px unless --budget-px is given), which do not, and what each
    /// costs.
    #[arg(long)]
    pub explain: bool,
    /// Layers beside the picture in an .exr, separated by commas, for compositing.
    #[arg(long, value_name = "LAYER,…", value_enum, value_delimiter = ',')]
    pub aov: Vec<LayerName>,
    /// Take all options that are not given from this .exr, which `viewer render` has written. The output is not among
    /// them.
    #[arg(long, value_name = "FILE")]
    pub like: Option<PathBuf>,
    /// How it is drawn.
    #[command(flatten)]
    pub drawing: DrawingArgs,
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// The stars in front of its sky.
    #[command(flatten)]
    pub stars: StarArgs,
    /// The disc around the hole.
    #[command(flatten)]
    pub disc: DiscArgs,
    /// What an .exr records of these options; `None` if a value is not UTF-8.
    #[arg(skip)]
    pub recorded: Option<RecordedOptions>,
}

/// How pictures are drawn.
#[derive(Debug, Clone, Args)]
pub struct DrawingArgs {
    /// Deflection method: table lookup, direct integration, or no deflection.
    #[arg(long, value_enum, default_value_t = MethodName::Lut)]
    pub method: MethodName,
    /// What a pixel shows: the mean over its area, the same by the anisotropic filter of the GPU, or one ray through its
    /// centre.
    #[arg(long, value_enum, default_value_t = SamplingName::Filtered)]
    pub sampling: SamplingName,
    /// Kind of passes in which the GPU draws [default: compute, where the GPU has compute shaders].
    #[arg(long, value_enum)]
    pub pass: Option<PassName>,
    /// Exposure of a .png in stops, from -32 to 32; each stop doubles the brightness. `auto` makes up for the mean
    /// brightness of the frequency shift. An .exr is not affected.
    #[arg(long, value_name = "EV|auto", default_value = "0", allow_negative_numbers = true, value_parser = exposure)]
    pub exposure: Exposure,
    /// The projection.
    #[command(flatten)]
    pub projection: ProjectionArgs,
}

/// Layer of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LayerName {
    /// Direction on the sky that the light comes from.
    Direction,
    /// Frequency shift.
    Shift,
    /// Magnification, negative for mirrored images.
    Magnification,
    /// Image order: how often the light crosses the axis through the camera and the hole.
    Order,
    /// Place on a panorama (STMap).
    Uv,
    /// Share of the pixel that lies in the shadow.
    Captured,
    /// Radius at which the pixel shows the disc, in Schwarzschild radii.
    #[value(name = "disc_radius")]
    DiscRadius,
    /// Image order of the disc: how many half turns around the hole its light makes.
    #[value(name = "disc_order")]
    DiscOrder,
    /// Frequency shift of the disc's light.
    #[value(name = "disc_shift")]
    DiscShift,
    /// Share of the light behind the disc that the pixel does not show.
    #[value(name = "disc_alpha")]
    DiscAlpha,
    /// All of these; those of a disc if there is one.
    All,
}

/// A layer of a disc without the disc.
#[derive(Debug, Error)]
#[error("--aov: {} is for a disc, and there is none; add --disc", _0.name())]
pub struct LayerNeedsDisc(Layer);

impl LayerName {
    /// The layers of all these names, in a picture with this disc.
    ///
    /// # Errors
    /// [`LayerNeedsDisc`] if one is that of a disc, and there is none.
    pub fn layers_of(names: &[LayerName], disc: &DiscArgs) -> Result<Vec<Layer>, LayerNeedsDisc> {
        let there = |layer: &Layer| disc.disc.is_some() || !layer.is_of_disc();
        let mut layers = Vec::new();
        for name in names {
            match name.layer() {
                Some(layer) if there(&layer) => layers.push(layer),
                Some(layer) => return Err(LayerNeedsDisc(layer)),
                None => layers.extend(Layer::ALL.into_iter().filter(there)),
            }
        }
        Ok(layers)
    }

    /// The layer of this name; `None` for all.
    fn layer(self) -> Option<Layer> {
        Some(match self {
            LayerName::Direction => Layer::Direction,
            LayerName::Shift => Layer::Shift,
            LayerName::Magnification => Layer::Magnification,
            LayerName::Order => Layer::Order,
            LayerName::Uv => Layer::Uv,
            LayerName::Captured => Layer::Captured,
            LayerName::DiscRadius => Layer::DiscRadius,
            LayerName::DiscOrder => Layer::DiscOrder,
            LayerName::DiscShift => Layer::DiscShift,
            LayerName::DiscAlpha => Layer::DiscAlpha,
            LayerName::All => return None,
        })
    }
}

/// Point stars.
#[derive(Debug, Clone, Args)]
pub struct StarArgs {
    /// Stars in front of the sky: `hipparcos`, or a catalogue file: CSV with the columns ra, dec (degrees, J2000),
    /// mag and optionally bv, or the compact format. With `--sky stars` the default is hipparcos.
    #[arg(long, value_name = "STARS", value_parser = OsStringValueParser::new().try_map(stars))]
    pub stars: Option<StarSource>,
    /// Exposure of the stars in stops, from -30 to 30; each stop doubles their light.
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        value_parser = stops,
        allow_negative_numbers = true
    )]
    pub star_exposure: f64,
    /// Angular radius of every star in rad, above 0 and at most 0.001, instead of the catalogue's; it limits the
    /// magnification of a star behind the hole.
    #[arg(long, value_name = "RAD", allow_negative_numbers = true)]
    pub star_radius: Option<f64>,
}

impl StarArgs {
    /// The source of the stars before this sky, if there are any. The sky `stars` has the Hipparcos stars unless others
    /// are named.
    pub fn source(&self, sky: &SkySource) -> Option<StarSource> {
        let built_in = (*sky == SkySource::Stars).then_some(StarSource::Hipparcos);
        self.stars.clone().or(built_in)
    }
}

/// Options of `viewer catalogue`.
#[derive(Debug, Args)]
pub struct CatalogueArgs {
    /// Raw Hipparcos file: hip2.dat of CDS I/311.
    #[arg(value_name = "RAW")]
    pub raw: PathBuf,
    /// Compact catalogue to write; - is standard output.
    #[arg(short, long, value_name = "FILE", default_value = "hipparcos.stars")]
    pub output: PathBuf,
}

/// Options of `viewer diff`.
#[derive(Debug, Args)]
pub struct DiffArgs {
    /// Heat map to write (PNG): the difference between table lookup and direct integration, in image space.
    #[arg(short, long, value_name = "FILE", default_value = "diff.png")]
    pub output: PathBuf,
    /// Largest allowed error of the lookup against the closed form, in pixels of image space; if it is exceeded,
    /// the exit code is 1.
    #[arg(long, value_name = "PX", default_value_t = 0.002)]
    pub budget_px: f64,
    /// Draw with the least model within the budget instead of the whole row.
    #[arg(long)]
    pub least: bool,
    /// Print which models keep the error budget, which do not, and what each costs.
    #[arg(long)]
    pub explain: bool,
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,
}

/// Options of the window.
#[derive(Debug, Args)]
pub struct WindowArgs {
    /// Size of the window in logical pixels (points).
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: (u32, u32),
    /// Fill the screen.
    #[arg(long)]
    pub fullscreen: bool,
    /// Play a path of the camera: a JSON file of keyframes, as `viewer film` takes it.
    #[arg(long, value_name = "FILE")]
    pub play: Option<PathBuf>,
    /// Kind of passes in which the GPU draws [default: compute, where the GPU has compute shaders].
    #[arg(long, value_enum)]
    pub pass: Option<PassName>,
    /// View and sky at the start.
    #[command(flatten)]
    pub view: ViewArgs,
    /// The stars in front of its skies.
    #[command(flatten)]
    pub stars: StarArgs,
    /// The disc around the hole at the start.
    #[command(flatten)]
    pub disc: DiscArgs,
}
