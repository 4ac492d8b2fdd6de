//! Options of what measures.

use super::scene::DeviceName;
use super::values::size;
use clap::Args;
use std::path::PathBuf;
use viewer::camera::View;

/// Options of `viewer chart`.
#[derive(Debug, Args)]
pub struct ChartArgs {
    /// Folder to write gpu.csv, gpu.svg and gpu.png to.
    #[arg(short, long, value_name = "DIR", default_value = "chart")]
    pub output: PathBuf,
    /// Size of the picture [default: 1920x1080, with --quick 320x180].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Field of view across the picture, between 0 and 180.
    #[arg(long, value_name = "DEG", default_value_t = View::default().fov_deg, allow_negative_numbers = true)]
    pub fov: f64,
    /// Radius of the camera, above 1 (the horizon).
    #[arg(short, long, value_name = "R", default_value_t = View::default().radius, allow_negative_numbers = true)]
    pub radius: f64,
    /// A small picture and few rounds: seconds, to see that it works.
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
    /// Length of the flight at each size, in seconds.
    #[arg(
        long,
        value_name = "S",
        default_value_t = 10.0,
        allow_negative_numbers = true
    )]
    pub seconds: f64,
    /// Frames of each method at each size at the least, however long they take.
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub rounds: u32,
    /// File to write the figures to as comma-separated values; - is standard output, and the report goes to
    /// standard error.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// File to write the figures to as JSON, or - as for --csv.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
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
    /// Measure what filtering costs at 1920x1080 instead; writes nothing.
    #[arg(long)]
    pub cost: bool,
    /// Rays along the side of a pixel of the reference.
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
    /// Radius of the orbit, above 1 (the horizon).
    #[arg(short, long, value_name = "R", default_value_t = View::default().radius, allow_negative_numbers = true)]
    pub radius: f64,
    /// Frames of the orbit.
    #[arg(long, value_name = "N", default_value_t = 240, value_parser = clap::value_parser!(u32).range(8..=10_000))]
    pub frames: u32,
    /// Stars: the brightest of Hipparcos that come into the pictures.
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub stars: u32,
    /// What draws three of the stars once more, beside the CPU: `gpu`, `auto` if there is one, `cpu` for
    /// nothing.
    #[arg(short, long, value_enum, default_value_t = DeviceName::Auto)]
    pub device: DeviceName,
}
