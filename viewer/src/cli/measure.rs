//! Options of the commands that measure: `chart`, `bench`, `reference` and `flicker`.

use super::scene::{DeviceName, PassName};
use super::values::size;
use clap::Args;
use lensbake_core::Motion;
use lensbake_render::camera::View;
use std::path::PathBuf;

/// Options of `viewer chart`.
#[derive(Debug, Args)]
pub struct ChartArgs {
    /// Folder to write gpu.csv, gpu.svg and gpu.png to.
    #[arg(short, long, value_name = "DIR", default_value = "chart")]
    pub output: PathBuf,
    /// Size of the picture [default: 1920x1080, with --quick 320x180].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Horizontal field of view, between 0 and 180.
    #[arg(long, value_name = "DEG", default_value_t = View::default().fov_deg, allow_negative_numbers = true)]
    pub fov: f64,
    /// Radial coordinate r of the camera in Schwarzschild radii, above 1 (the horizon).
    #[arg(short, long, value_name = "R", default_value_t = View::default().radius, allow_negative_numbers = true)]
    pub radius: f64,
    /// Use a small picture and few rounds: a check that takes seconds.
    #[arg(long)]
    pub quick: bool,
}

/// Options of `viewer bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Sizes of the picture, separated by commas
    /// [default: 480x270,960x540,1920x1080,3840x2160].
    #[arg(long, value_name = "WxH,…", value_parser = size, value_delimiter = ',')]
    pub sizes: Option<Vec<(u32, u32)>>,
    /// Duration of the flight at each size in seconds, from 0 to 3600.
    #[arg(
        long,
        value_name = "S",
        default_value_t = 10.0,
        allow_negative_numbers = true
    )]
    pub seconds: f64,
    /// Radial coordinate r of the camera in all frames, in Schwarzschild radii, above 1.5 [default: a flight between 2.5 and
    /// 37.5].
    #[arg(short, long, value_name = "R", allow_negative_numbers = true)]
    pub radius: Option<f64>,
    /// Least number of frames of each method at each size, however long they take.
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub rounds: u32,
    /// Kind of passes in which the GPU draws, except where the name of a method says otherwise [default: compute, where the GPU has compute shaders].
    #[arg(long, value_enum)]
    pub pass: Option<PassName>,
    /// File to write the results to as CSV; with -, they go to standard output and the report to standard error.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// File to write the results to as JSON; - as for --csv.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Draw the time per ray against the size of the picture to this SVG file; - as for --csv.
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
}

/// Options of `viewer reference`.
#[derive(Debug, Args)]
pub struct ReferenceArgs {
    /// Folder to write filter.csv and the figures to.
    #[arg(short, long, value_name = "DIR", default_value = "filter")]
    pub output: PathBuf,
    /// Size of the pictures.
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = size)]
    pub size: (u32, u32),
    /// Measure the cost of filtering at 1920x1080 instead; writes no files.
    #[arg(long)]
    pub cost: bool,
    /// Compare pictures of a disc instead, and write disc.csv and disc.png.
    #[arg(long, conflicts_with = "cost")]
    pub disc: bool,
    /// Only the views whose name contains this text, such as "r = 4" or "90°"; with --disc.
    #[arg(long, value_name = "TEXT", requires = "disc")]
    pub only: Option<String>,
    /// Device that draws the pictures of a disc: `cpu`, `gpu` (and the CPU), or `auto` (the GPU too, if there is one).
    #[arg(short, long, value_enum, default_value_t = DeviceName::Auto, requires = "disc")]
    pub device: DeviceName,
    /// Rays along each side of a pixel of the reference picture (N x N rays per pixel).
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(2..=64))]
    pub rays: u32,
}

/// Options of `viewer flicker`.
#[derive(Debug, Args)]
pub struct FlickerArgs {
    /// Folder to write flicker.csv and flicker.png to.
    #[arg(short, long, value_name = "DIR", default_value = "docs/stars")]
    pub output: PathBuf,
    /// Size of the pictures.
    #[arg(long, value_name = "WxH", default_value = "480x270", value_parser = size)]
    pub size: (u32, u32),
    /// Radial coordinate r of the orbit in Schwarzschild radii, above 1 (the horizon); of a fall, where it begins.
    #[arg(short, long, value_name = "R", default_value_t = View::default().radius, allow_negative_numbers = true)]
    pub radius: f64,
    /// Motion of the camera: `rest` is carried around the hole at rest, `orbit` moves freely around it, `fall` falls to
    /// r = 0.05. For a moving camera the light is measured with the brightness of its frequency shift.
    #[arg(
        long,
        value_name = "rest|fall|orbit|BR,BT",
        default_value = "rest",
        allow_hyphen_values = true
    )]
    pub motion: Motion,
    /// Look this far to the right of the hole.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub yaw: f64,
    /// Number of frames.
    #[arg(long, value_name = "N", default_value_t = 240, value_parser = clap::value_parser!(u32).range(8..=10_000))]
    pub frames: u32,
    /// Number of stars: the brightest of Hipparcos that appear in the pictures.
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub stars: u32,
    /// Device that draws three of the stars again, after the CPU: `gpu`, `auto` (the GPU if there is one), or
    /// `cpu` (none is drawn again).
    #[arg(short, long, value_enum, default_value_t = DeviceName::Auto)]
    pub device: DeviceName,
}
