//! The command line.

mod draw;
mod measure;
mod scene;
mod values;

pub use draw::{CatalogueArgs, DiffArgs, PICTURE, RenderArgs, StarArgs, WindowArgs};
pub use measure::{BenchArgs, ChartArgs, FlickerArgs, ReferenceArgs};
pub use scene::{DeviceName, MethodName, SamplingName, SceneArgs, ViewArgs};

use clap::{Parser, Subcommand};

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
    /// Measure how much stars flicker in an orbit, against the analytic curve of their light.
    Flicker(FlickerArgs),
    /// Turn the raw Hipparcos file, hip2.dat of CDS I/311, into the compact catalogue.
    Catalogue(CatalogueArgs),
}
