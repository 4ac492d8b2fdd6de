//! Options of `viewer film`.

use super::disc::DiscArgs;
use super::draw::{DrawingArgs, LayerName, StarArgs};
use super::recorded::RecordedOptions;
use super::scene::{DeviceName, LightArgs};
use super::values::size;
use clap::{Args, ValueEnum};
use lensbake_film::{FrameRange, FrameRate, ReadyPath};
use std::path::PathBuf;

/// Options of `viewer film`.
#[derive(Debug, Args)]
pub struct FilmArgs {
    /// Path of the camera: a JSON file of keyframes.
    #[arg(
        value_name = "FILE",
        conflicts_with = "path",
        required_unless_present = "path"
    )]
    pub file: Option<PathBuf>,
    /// Ready path instead of a file.
    #[arg(long, value_enum, value_name = "NAME")]
    pub path: Option<PathName>,
    /// Radius of the ready path: of the orbit [default: 10], where the fall [6] or the dive [40] begins, or the least of
    /// the flyby [3].
    #[arg(
        short,
        long,
        value_name = "R",
        conflicts_with = "file",
        allow_negative_numbers = true
    )]
    pub radius: Option<f64>,
    /// Length of the film. A ready path is flown in this time [default: 10]; a file's path is cut there, or its end goes on
    /// [default: its last keyframe].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Frames per second, a number or a ratio such as 30000/1001.
    #[arg(long, value_name = "N", default_value = "30")]
    pub fps: FrameRate,
    /// Frames to draw: from frame A to before frame B, every STEP-th [default: all]. Frames are numbered from 0;
    /// A or B may be left out.
    #[arg(long, value_name = "A..B[:STEP]")]
    pub frames: Option<FrameRange>,
    /// Files of the frames, such as frames/%05d.png or .exr (linear light); or a video, .mp4, .mkv or .webm, which ffmpeg
    /// writes.
    #[arg(
        short,
        long,
        value_name = "FILE",
        required_unless_present = "save_path"
    )]
    pub output: Option<PathBuf>,
    /// Draw frames anew whose files exist. Otherwise they are skipped.
    #[arg(long)]
    pub overwrite: bool,
    /// Write the path to a file, as a start for one of your own, and draw nothing.
    #[arg(long, value_name = "FILE", conflicts_with = "output")]
    pub save_path: Option<PathBuf>,
    /// Motion blur: the part of a frame's time in which the shutter is open, from 0 (no blur) to 1; film cameras have 0.5.
    #[arg(
        long,
        value_name = "FRACTION",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub shutter: f64,
    /// Pictures whose mean is a frame with motion blur.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub subframes: u32,
    /// Layers beside the picture in the .exr of each frame, separated by commas, for compositing.
    #[arg(long, value_name = "LAYER,…", value_enum, value_delimiter = ',')]
    pub aov: Vec<LayerName>,
    /// Size of the frames [default: 1920x1080, a panorama 4096x2048, a fisheye or dome 2048x2048, a face of a cube
    /// 1024x1024].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Field of view of all frames, instead of that of the path: below 180, of a fisheye or dome up to 360 [default: 180].
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub fov: Option<f64>,
    /// Device to draw on; `auto` is the GPU if there is one.
    #[arg(short, long, value_enum, default_value_t = DeviceName::Auto)]
    pub device: DeviceName,
    /// Sky, table and frequency shift.
    #[command(flatten)]
    pub light: LightArgs,
    /// How it is drawn.
    #[command(flatten)]
    pub drawing: DrawingArgs,
    /// The stars in front of its sky.
    #[command(flatten)]
    pub stars: StarArgs,
    /// The disc around the hole.
    #[command(flatten)]
    pub disc: DiscArgs,
    /// Time of the disc's pattern that passes in a second of the film, in r_s/c; it begins with --disc-time and is the same for
    /// all paths, also where the camera's own clock is slow [default: the inner rim turns once in 10 s].
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    pub disc_rate: Option<f64>,
    /// What an .exr records of these options; `None` if a value is not UTF-8.
    #[arg(skip)]
    pub recorded: Option<RecordedOptions>,
}

impl FilmArgs {
    /// Size of the frames, pixels.
    pub fn size(&self) -> (u32, u32) {
        self.size.unwrap_or(self.drawing.projection.default_size())
    }
}

/// A ready path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PathName {
    /// Once round the hole in orbit.
    Orbit,
    /// Free fall through the horizon to r = 0.05.
    Fall,
    /// Past the hole.
    Flyby,
    /// From afar down to r = 1.1, at rest.
    Dive,
}

impl From<PathName> for ReadyPath {
    fn from(name: PathName) -> Self {
        match name {
            PathName::Orbit => ReadyPath::Orbit,
            PathName::Fall => ReadyPath::Fall,
            PathName::Flyby => ReadyPath::Flyby,
            PathName::Dive => ReadyPath::Dive,
        }
    }
}
