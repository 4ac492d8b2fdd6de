//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use viewer::camera::View;
use viewer::scene::Method;
use viewer::sky::SkySource;
use viewer::stars::StarSource;
use viewer::tone_map::EXPOSURES;

/// Draw the sky as a black hole bends it: without a command, in a window.
///
/// Lengths are in units of the Schwarzschild radius, angles in degrees. Exit code 0: done, 1: a budget
/// was missed, 2: bad usage or input.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// What to do instead.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The window.
    #[command(flatten)]
    pub window: WindowArgs,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a picture to a file.
    Render(RenderArgs),
    /// Draw by lookup and by direct integration, and say how far they are apart.
    Diff(DiffArgs),
    /// Chart speed against accuracy of every way to draw, on the GPU at hand.
    Chart(ChartArgs),
    /// Frames a second and time a ray at several sizes, on the GPU at hand: undeflected, by the table,
    /// and by direct integration, on a flight between r = 2.5 and 37.5.
    Bench(BenchArgs),
    /// Measure the filtered picture against many rays a pixel by direct integration.
    Reference(ReferenceArgs),
    /// Turn the raw Hipparcos file, hip2.dat of CDS I/311, into the compact catalogue.
    Catalogue(CatalogueArgs),
}

/// Options of `viewer render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Picture to write: .png as a screen shows it, .exr in linear light.
    #[arg(short, long, value_name = "FILE", default_value = "lensed.png")]
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
#[derive(Debug, Args)]
pub struct StarArgs {
    /// Stars before the sky: `hipparcos`, or a catalogue: CSV with the columns ra, dec (degrees, J2000),
    /// mag and, if known, bv; or the compact format. `--sky stars` alone means hipparcos.
    #[arg(long, value_name = "STARS", value_parser = stars)]
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
    /// Compact catalogue to write.
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
    /// File to write the figures to as comma-separated values.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// File to write the figures to as JSON.
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

/// The scene and what draws it.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// Size of the picture.
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = size)]
    pub size: (u32, u32),
    /// Where to draw. `auto` takes the GPU if there is one.
    #[arg(short, long, value_enum, default_value_t = DeviceName::Auto)]
    pub device: DeviceName,
    /// The rest of it.
    #[command(flatten)]
    pub view: ViewArgs,
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

/// Where the camera is, how it looks, and at what.
#[derive(Debug, Args)]
pub struct ViewArgs {
    /// Field of view across the picture, between 0 and 180.
    #[arg(long, value_name = "DEG", default_value_t = View::default().fov_deg, allow_negative_numbers = true)]
    pub fov: f64,
    /// Radius of the camera, above 1 (the horizon).
    #[arg(short, long, value_name = "R", default_value_t = View::default().radius, allow_negative_numbers = true)]
    pub radius: f64,
    /// Look this far to the right of the hole.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub yaw: f64,
    /// Look this far above the hole.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub pitch: f64,
    /// Roll the camera clockwise.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub roll: f64,
    /// Longitude of the camera about the hole.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub orbit: f64,
    /// Latitude of the camera about the hole.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub latitude: f64,
    /// The hole's place on the sky: right ascension and declination, J2000.
    #[arg(
        long,
        value_name = "RA,DEC",
        value_parser = place,
        conflicts_with_all = ["orbit", "latitude"],
        allow_hyphen_values = true
    )]
    pub hole: Option<(f64, f64)>,
    /// Sky: `nebula`, `starmap`, `grid`, `stars` (black, with the Hipparcos stars before it), a panorama (2:1), or six cube faces separated by commas:
    /// right,left,top,bottom,front,back. PNG, JPEG, HDR or EXR.
    #[arg(short, long, value_name = "SKY", default_value = "nebula", value_parser = sky)]
    pub sky: SkySource,
    /// Bending table [default: the built-in atlas].
    #[arg(short, long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// Step of direct integration on the orbit, in rad, from 0.001 to 0.5.
    #[arg(long, value_name = "RAD", default_value_t = Method::DEFAULT_STEP, allow_negative_numbers = true)]
    pub step: f64,
}

/// Who bends the light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// The table: one lookup a pixel.
    Lut,
    /// RK4 along every ray.
    Direct,
    /// Nobody; the horizon is a plain sphere.
    Flat,
}

/// What of its area a pixel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SamplingName {
    /// One ray through its middle.
    Single,
    /// The mean of all of it.
    Filtered,
}

/// Where to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DeviceName {
    /// On the GPU if there is one, else on the CPU.
    Auto,
    /// On the GPU.
    Gpu,
    /// On the CPU, in f64: the reference.
    Cpu,
}

impl ViewArgs {
    /// The view asked for, in a picture of this size.
    pub fn view(&self, (width, height): (u32, u32)) -> View {
        // Seen from the hole, the camera is opposite to where the hole is seen.
        let (orbit_deg, latitude_deg) = match self.hole {
            Some((right_ascension, declination)) => (right_ascension, -declination),
            None => (self.orbit, self.latitude),
        };
        View {
            radius: self.radius,
            orbit_deg,
            latitude_deg,
            yaw_deg: self.yaw,
            pitch_deg: self.pitch,
            roll_deg: self.roll,
            fov_deg: self.fov,
            width,
            height,
        }
    }
}

fn exposure(text: &str) -> Result<f32, String> {
    let stops = text.parse().ok().filter(|stops| EXPOSURES.contains(stops));
    stops.ok_or_else(|| {
        let (least, most) = (EXPOSURES.start(), EXPOSURES.end());
        format!("must be a number of stops from {least} to {most}")
    })
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text.split_once(['x', 'X']).and_then(|(width, height)| {
        let width = width.trim().parse().ok()?;
        Some((width, height.trim().parse().ok()?))
    });
    parsed.ok_or_else(|| "must be like 1920x1080".to_owned())
}

fn place(text: &str) -> Result<(f64, f64), String> {
    let parsed = text
        .split_once(',')
        .and_then(|(right_ascension, declination)| {
            let right_ascension: f64 = right_ascension.trim().parse().ok()?;
            Some((right_ascension, declination.trim().parse().ok()?))
        });
    parsed
        .filter(|(ra, dec)| (-360.0..=360.0).contains(ra) && (-90.0..=90.0).contains(dec))
        .ok_or_else(|| {
            "must be two angles in degrees like 83.8,-5.4: right ascension and declination"
                .to_owned()
        })
}

fn stops(text: &str) -> Result<f64, String> {
    let parsed = text.parse().ok().filter(|stops: &f64| stops.abs() <= 30.0);
    parsed.ok_or_else(|| "must be a number of stops from -30 to 30".to_owned())
}

fn stars(text: &str) -> Result<StarSource, String> {
    let path = PathBuf::from(text);
    if text == "hipparcos" {
        Ok(StarSource::Hipparcos)
    } else if path.exists() {
        Ok(StarSource::File(path))
    } else {
        Err("is neither a file nor the built-in catalogue hipparcos".to_owned())
    }
}

fn sky(text: &str) -> Result<SkySource, String> {
    let files: Vec<PathBuf> = text.split(',').map(PathBuf::from).collect();
    Ok(match text {
        "nebula" => SkySource::Nebula,
        "starmap" => SkySource::Starmap,
        "grid" => SkySource::Grid,
        "stars" => SkySource::Stars,
        _ if files.len() == 1 && !files[0].exists() => {
            return Err(
                "is neither a file nor a built-in sky (nebula, starmap, grid, stars)".to_owned(),
            );
        }
        _ if files.len() == 1 => SkySource::Panorama(PathBuf::from(text)),
        _ => SkySource::Faces(<[PathBuf; 6]>::try_from(files).map_err(|files| {
            format!(
                "must be one panorama or six cube faces, not {} files",
                files.len()
            )
        })?),
    })
}
