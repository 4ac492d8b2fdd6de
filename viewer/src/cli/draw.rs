//! Options of what draws: the window, the pictures, their stars.

use super::scene::{MethodName, SamplingName, SceneArgs, ViewArgs};
use super::values::{exposure, size, stars, stops};
use clap::Args;
use clap::builder::{OsStringValueParser, TypedValueParser};
use std::path::PathBuf;
use viewer::stars::StarSource;

/// The file that a picture is written to unless another is named.
pub const PICTURE: &str = "lensed.png";

/// Options of `viewer render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Picture to write: .png as a screen shows it, .exr in linear light, - for a .png on standard output.
    #[arg(short, long, value_name = "FILE", default_value = PICTURE)]
    pub output: PathBuf,
    /// Who bends the light: the table, direct integration, or nobody.
    #[arg(long, value_enum, default_value_t = MethodName::Lut)]
    pub method: MethodName,
    /// What of its area a pixel shows: all of it, or one ray through its middle.
    #[arg(long, value_enum, default_value_t = SamplingName::Filtered)]
    pub sampling: SamplingName,
    /// Exposure of a .png in stops, each twice as bright, from -32 to 32. An .exr holds all light as it is.
    #[arg(long, value_name = "EV", default_value_t = 0.0, allow_negative_numbers = true, value_parser = exposure)]
    pub exposure: f32,
    /// Draw by the least model with at most this error in image space, in pixels: the undeflected sky
    /// or the shortest row that will do. Exit code 1 if not even the whole row will.
    #[arg(
        long,
        value_name = "PX",
        conflicts_with = "method",
        allow_negative_numbers = true
    )]
    pub budget_px: Option<f64>,
    /// Say which model would do for the budget (or for 0.1 px), which would not, and what they cost.
    #[arg(long)]
    pub explain: bool,
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// The stars before its sky.
    #[command(flatten)]
    pub stars: StarArgs,
}

/// Point stars.
#[derive(Debug, Clone, Args)]
pub struct StarArgs {
    /// Stars before the sky: `hipparcos`, or a catalogue: CSV with the columns ra, dec (degrees, J2000),
    /// mag and, if known, bv; or the compact format. `--sky stars` alone means hipparcos.
    #[arg(long, value_name = "STARS", value_parser = OsStringValueParser::new().try_map(stars))]
    pub stars: Option<StarSource>,
    /// Exposure of the stars: each stop doubles their light.
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        value_parser = stops,
        allow_negative_numbers = true
    )]
    pub star_exposure: f64,
    /// Angular radius of every star in rad, above 0 and at most 0.001, in place of the catalogue's: it
    /// caps the magnification of a star behind the hole.
    #[arg(long, value_name = "RAD", allow_negative_numbers = true)]
    pub star_radius: Option<f64>,
}

/// Options of `viewer catalogue`.
#[derive(Debug, Args)]
pub struct CatalogueArgs {
    /// The raw file.
    #[arg(value_name = "RAW")]
    pub raw: PathBuf,
    /// Compact catalogue to write, - for standard output.
    #[arg(short, long, value_name = "FILE", default_value = "hipparcos.stars")]
    pub output: PathBuf,
}

/// Options of `viewer diff`.
#[derive(Debug, Args)]
pub struct DiffArgs {
    /// Heat map (PNG) of the lookup's distance from direct integration, in image space.
    #[arg(short, long, value_name = "FILE", default_value = "diff.png")]
    pub output: PathBuf,
    /// Largest error of the lookup against the closed form allowed in image space, in pixels; above
    /// it the exit code is 1.
    #[arg(long, value_name = "PX", default_value_t = 0.002)]
    pub budget_px: f64,
    /// Draw by the least model within the budget in place of the whole row.
    #[arg(long)]
    pub least: bool,
    /// Say which model would do for the budget, which would not, and what they cost.
    #[arg(long)]
    pub explain: bool,
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,
}

/// Options of the window.
#[derive(Debug, Args)]
pub struct WindowArgs {
    /// Size of the window, in points: pixels of a screen that is not high-DPI.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: (u32, u32),
    /// Fill the screen.
    #[arg(long)]
    pub fullscreen: bool,
    /// What it shows at the start.
    #[command(flatten)]
    pub view: ViewArgs,
    /// The stars before its skies.
    #[command(flatten)]
    pub stars: StarArgs,
}
