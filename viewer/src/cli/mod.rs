//! The command line.

mod disc;
mod draw;
mod film;
mod like;
mod measure;
mod projection;
mod read;
mod recorded;
mod scene;
mod values;

pub use disc::{DiscArgsError, shift_name};
pub use draw::{
    CatalogueArgs, DiffArgs, DrawingArgs, LayerName, LayerNeedsDisc, PICTURE, RenderArgs, StarArgs,
    WindowArgs,
};
pub use film::FilmArgs;
pub use measure::{BenchArgs, ChartArgs, FlickerArgs, ReferenceArgs};
pub use projection::{ProjectionArgs, disc_fov_deg};
pub use read::read;
pub use recorded::{ATTRIBUTE, PROGRAM, RecordedOptions};
pub use scene::{DeviceName, LightArgs, MethodName, PassName, SamplingName, SceneArgs};
pub use values::Exposure;

use clap::{Parser, Subcommand};

/// Draw the sky as a black hole deflects its light (gravitational lensing). Without a command, opens a window.
///
/// Lengths are in units of the Schwarzschild radius, angles in degrees. Exit code 0: done, 1: a budget
/// was missed, 2: bad usage or input.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// The command to run instead of opening the window.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Options of the window.
    #[command(flatten)]
    pub window: WindowArgs,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a picture to a file.
    Render(RenderArgs),
    /// Draw the frames of a film along a path of keyframes, or a video.
    Film(FilmArgs),
    /// Draw by table lookup and by direct integration, and report how much they differ.
    Diff(DiffArgs),
    /// Chart speed against accuracy of every method of drawing, on this machine's GPU.
    Chart(ChartArgs),
    /// Measure frames per second and time per ray at several sizes on this machine's GPU: undeflected, by table
    /// lookup, and by direct integration, on a flight between r = 2.5 and 37.5.
    Bench(BenchArgs),
    /// Measure the error of the filtered picture against many rays per pixel by direct integration.
    Reference(ReferenceArgs),
    /// Measure how much stars flicker during an orbit or a fall, against their analytic light curves.
    Flicker(FlickerArgs),
    /// Convert the raw Hipparcos file, hip2.dat of CDS I/311, to the compact catalogue.
    Catalogue(CatalogueArgs),
}
