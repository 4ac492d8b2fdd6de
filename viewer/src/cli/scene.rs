//! Options of a scene: the view, the sky, and what draws it.

use super::values::{place, size, sky};
use clap::builder::{OsStringValueParser, TypedValueParser};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use viewer::camera::View;
use viewer::scene::Method;
use viewer::sky::SkySource;

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

/// Where the camera is, how it looks, and at what.
#[derive(Debug, Clone, Args)]
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
    #[arg(short, long, value_name = "SKY", default_value = "nebula", value_parser = OsStringValueParser::new().try_map(sky))]
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
