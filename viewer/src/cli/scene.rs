//! Options of a scene: view, sky, table and device.

use super::projection::disc_fov_deg;
use super::values::{place, size, sky};
use clap::builder::{OsStringValueParser, TypedValueParser};
use clap::{Args, ValueEnum};
use lensbake_core::Motion;
use lensbake_render::camera::{Projection, View};
use lensbake_render::gpu::Pass;
use lensbake_render::lens::Deflection;
use lensbake_render::scene::Sampling;
use lensbake_render::shift::Shift;
use lensbake_render::sky::SkySource;
use std::path::PathBuf;

/// The scene, and the device that draws it.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// Size of the picture [default: 1920x1080; in commands with --projection, a panorama 4096x2048, a fisheye or dome
    /// 2048x2048, a face of a cube 1024x1024].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Device to draw on; `auto` is the GPU if there is one.
    #[arg(short, long, value_enum, default_value_t = DeviceName::Auto)]
    pub device: DeviceName,
    /// View, sky and table.
    #[command(flatten)]
    pub view: ViewArgs,
}

/// Position and orientation of the camera, and the light that it sees.
#[derive(Debug, Clone, Args)]
pub struct ViewArgs {
    /// Horizontal field of view: above 0 and below 180 [default: 90]. In commands with --projection, that of a fisheye or
    /// dome is up to 360 [default: 180].
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub fov: Option<f64>,
    /// Radial coordinate r of the camera in Schwarzschild radii: above 1 (the horizon) at rest, above 1.5 in orbit, from
    /// 0.01 in free fall.
    #[arg(short, long, value_name = "R", default_value_t = View::default().radius, allow_negative_numbers = true)]
    pub radius: f64,
    /// Motion of the camera: `rest`, `fall` (freely, from rest at infinity), `orbit` (circular), or a velocity BR,BT in
    /// units of c: radial (positive outwards) and tangential, relative to the observer at rest, at the horizon and below
    /// to the observer in free fall.
    #[arg(
        long,
        value_name = "rest|fall|orbit|BR,BT",
        default_value = "rest",
        allow_hyphen_values = true
    )]
    pub motion: Motion,
    /// Heading of the tangential part of the motion: 0 is east (growing longitude, to the right when looking at the
    /// hole), 90 is north.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub heading: f64,
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
    /// Longitude of the camera around the hole.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub orbit: f64,
    /// Latitude of the camera around the hole.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub latitude: f64,
    /// Position of the hole on the sky, instead of --orbit and --latitude: right ascension and declination, J2000.
    #[arg(
        long,
        value_name = "RA,DEC",
        value_parser = place,
        conflicts_with_all = ["orbit", "latitude"],
        allow_hyphen_values = true
    )]
    pub hole: Option<(f64, f64)>,
    /// Sky, table and frequency shift.
    #[command(flatten)]
    pub light: LightArgs,
}

/// Where light comes from, what bends it, and how it is shown.
#[derive(Debug, Clone, Args)]
pub struct LightArgs {
    /// Sky: `nebula`, `starmap`, `grid`, `stars` (black, with the Hipparcos stars unless --stars names others), a
    /// 2:1 panorama, or six cube faces separated by commas: right,left,top,bottom,front,back. Files are PNG, JPEG,
    /// HDR or EXR.
    #[arg(short, long, value_name = "SKY", default_value = "nebula", value_parser = OsStringValueParser::new().try_map(sky))]
    pub sky: SkySource,
    /// Bending table file [default: the built-in atlas].
    #[arg(short, long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// Step of direct integration in orbital angle, in rad, from 0.001 to 0.5.
    #[arg(long, value_name = "RAD", default_value_t = Deflection::DEFAULT_STEP, allow_negative_numbers = true)]
    pub step: f64,
    /// What of the frequency shift (gravitational and Doppler) is shown: nothing, the brightness, or the colour as well.
    #[arg(long, value_enum, default_value_t = ShiftName::Off)]
    pub shift: ShiftName,
}

/// Deflection method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Table lookup: one per pixel.
    Lut,
    /// Direct integration: RK4 along every ray.
    Direct,
    /// No deflection; the horizon is a plain sphere.
    Flat,
}

impl MethodName {
    /// The method, with this step of direct integration in rad.
    pub fn with_step(self, step: f64) -> Deflection {
        match self {
            MethodName::Lut => Deflection::Lut,
            MethodName::Direct => Deflection::Direct { step },
            MethodName::Flat => Deflection::Flat,
        }
    }
}

/// What of the frequency shift is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ShiftName {
    /// Nothing: light keeps its brightness and colour.
    Off,
    /// The brightness: g⁴ for the frequency ratio g.
    Brightness,
    /// The brightness and the colour: black bodies at g times their temperature.
    Colour,
}

impl From<ShiftName> for Shift {
    fn from(name: ShiftName) -> Self {
        match name {
            ShiftName::Off => Shift::Off,
            ShiftName::Brightness => Shift::Brightness,
            ShiftName::Colour => Shift::Colour,
        }
    }
}

impl From<Shift> for ShiftName {
    fn from(shift: Shift) -> Self {
        match shift {
            Shift::Off => ShiftName::Off,
            Shift::Brightness => ShiftName::Brightness,
            Shift::Colour => ShiftName::Colour,
        }
    }
}

/// How a pixel samples its area.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SamplingName {
    /// One ray through its centre.
    Single,
    /// The mean over its area.
    Filtered,
    /// The mean over its area by the anisotropic filter of the GPU, which is fast where the GPU has one in hardware.
    Anisotropic,
}

impl From<SamplingName> for Sampling {
    fn from(name: SamplingName) -> Self {
        match name {
            SamplingName::Single => Sampling::Single,
            SamplingName::Filtered => Sampling::Filtered,
            SamplingName::Anisotropic => Sampling::Anisotropic,
        }
    }
}

/// Kind of passes in which a GPU draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PassName {
    /// Compute passes.
    Compute,
    /// Render passes, as in WebGL2.
    Fragment,
}

impl From<PassName> for Pass {
    fn from(name: PassName) -> Self {
        match name {
            PassName::Compute => Pass::Compute,
            PassName::Fragment => Pass::Fragment,
        }
    }
}

/// Device to draw on.
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
    /// The view that the options describe, for a picture of this size in this projection.
    pub fn view(&self, (width, height): (u32, u32), projection: Projection) -> View {
        let fov_deg = self.fov.or(disc_fov_deg(projection));
        let fov_deg = fov_deg.unwrap_or(View::default().fov_deg);
        let [orbit_deg, latitude_deg] = self.given_by_hole().unwrap_or([self.orbit, self.latitude]);
        View {
            radius: self.radius,
            motion: self.motion,
            heading_deg: self.heading,
            orbit_deg,
            latitude_deg,
            yaw_deg: self.yaw,
            pitch_deg: self.pitch,
            roll_deg: self.roll,
            projection,
            fov_deg,
            width,
            height,
        }
    }

    /// Longitude and latitude from which --inclination is that of the line of sight, degrees: those of the camera if the
    /// hole's place on the sky is given, else 0, so that the camera moves round a disc that stays.
    pub fn disc_seen_from_deg(&self) -> [f64; 2] {
        self.given_by_hole().unwrap_or_default()
    }

    /// Longitude and latitude of the camera if the hole's place on the sky is given, degrees: the direction from the hole
    /// to the camera is opposite to the one in which the camera sees the hole.
    fn given_by_hole(&self) -> Option<[f64; 2]> {
        let (right_ascension, declination) = self.hole?;
        Some([right_ascension, -declination])
    }
}
