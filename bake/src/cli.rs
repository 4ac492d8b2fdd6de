//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use lensbake_core::Observer;
use std::path::PathBuf;

/// Bake the bending of light by a black hole into a table, and check it.
///
/// Without a command, bakes a table: without any argument the atlas for all observers. Lengths are in
/// units of the Schwarzschild radius. Exit code 0: done, 1: a budget was missed, 2: bad usage or input.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// What to do instead of baking.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// What to bake.
    #[command(flatten)]
    pub bake: BakeArgs,
}

/// What to do instead of baking.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Print a table's header, size and stated error.
    Inspect {
        /// The table (.lbt or .exr).
        file: PathBuf,
    },
    /// Write a table in the container that the second file's ending asks for: .lbt or .exr.
    Convert {
        /// The table to read.
        from: PathBuf,
        /// The table to write; - for a .lbt on standard output.
        to: PathBuf,
    },
    /// Read lines `R THETA_DEG` or `inf B` from standard input; print the bending in radians, or
    /// `captured`, for each as it comes.
    Query(QueryArgs),
    /// Compare a table with the direct integrator and with the closed form, off its nodes.
    Diff(DiffArgs),
    /// Chart speed against accuracy: every method on the same rays, in one run.
    ///
    /// Writes chart.csv, and chart-px and chart-rad as SVG and PNG. Exit code 1 if a method beats the
    /// default row: more accurate and faster, beyond the run's noise, at no more bytes a frame.
    Chart(ChartArgs),
    /// Try every method in every regime: at the shadow's edge, at the horizon, with no ray at all.
    ///
    /// Writes atlas.csv, and the atlas as SVG and PNG. Exit code 1 if this project's own methods are
    /// neither right nor refuse in words what is no ray.
    Stability(StabilityArgs),
}

/// What to bake.
#[derive(Debug, Args)]
pub struct BakeArgs {
    /// File to write, .lbt (binary) or .exr (OpenEXR), or - for a .lbt on standard output; may be given
    /// more than once.
    #[arg(short, long, value_name = "FILE", default_value = "atlas.lbt")]
    pub output: Vec<PathBuf>,
    /// Bake one row for this static observer instead of the atlas: a radius above 1, or `far`.
    #[arg(long, value_name = "far|R", value_parser = observer)]
    pub observer: Option<Observer>,
    /// Texels of a row [default: 64 for the residual axis, 1024 for the others].
    #[arg(long, value_name = "N")]
    pub texels: Option<u32>,
    /// Rows of the atlas [default: 128].
    #[arg(long, value_name = "N", conflicts_with = "observer")]
    pub rows: Option<u32>,
    /// Error asked of the integrator, in rad a radian of orbital angle, from 1e-13 to 1e-2.
    #[arg(long, value_name = "RAD", default_value_t = 1e-9, value_parser = tolerance)]
    pub tolerance: f64,
    /// Axis along the row. All but `residual` are naive, and hold the far observer's row only.
    #[arg(long, value_enum, default_value_t = AxisName::Residual)]
    pub axis: AxisName,
    /// Least impact parameter of a naive axis.
    #[arg(long, value_name = "B", default_value_t = 2.598_1, requires = "axis")]
    pub b_min: f64,
    /// Greatest impact parameter of a naive axis.
    #[arg(long, value_name = "B", default_value_t = 100.0, requires = "axis")]
    pub b_max: f64,
    /// Exit with code 1, writing nothing, if the measured error is larger than this, in rad.
    #[arg(long, value_name = "RAD", value_parser = positive)]
    pub budget: Option<f64>,
    /// Threads to bake with [default: one a core]. The bytes written are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// The axes by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AxisName {
    /// The residual against q = √(1−√x): this project's own.
    Residual,
    /// Uniform in b.
    B,
    /// Uniform in 1/b.
    InverseB,
    /// Uniform in ln(b/b_c − 1).
    LogB,
}

/// How to find a bending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Look it up in the table.
    Lut,
    /// Integrate by RK4.
    Rk4,
    /// Evaluate the closed form.
    Exact,
}

/// Options of `bake query`.
#[derive(Debug, Args)]
pub struct QueryArgs {
    /// Table to look up [default: the built-in atlas].
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// How the bending is found.
    #[arg(long, value_enum, default_value_t = Method::Lut)]
    pub method: Method,
    /// Error asked of RK4, in rad a radian of orbital angle, from 1e-13 to 1e-2.
    #[arg(long, value_name = "RAD", default_value_t = 1e-12, value_parser = tolerance)]
    pub tolerance: f64,
}

/// Options of `bake diff`.
#[derive(Debug, Args)]
pub struct DiffArgs {
    /// The table [default: the built-in atlas].
    pub file: Option<PathBuf>,
    /// Number of random rays, off the nodes and half of them crowding the edge.
    #[arg(long, value_name = "N", default_value_t = 100_000,
          value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    pub rays: u32,
    /// Seed of the random rays.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Error asked of the direct integrator, in rad a radian of orbital angle.
    #[arg(long, value_name = "RAD", default_value_t = 1e-11, value_parser = tolerance)]
    pub tolerance: f64,
    /// Largest error allowed against the closed form, in rad; above it the exit code is 1.
    #[arg(long, value_name = "RAD", default_value_t = 2e-6, value_parser = positive)]
    pub budget: f64,
    /// Largest error allowed in image space, in pixels; above it the exit code is 1.
    #[arg(long, value_name = "PX", default_value_t = 0.002, value_parser = positive)]
    pub budget_px: f64,
    /// Width of the picture in whose pixels errors are stated.
    #[arg(long, value_name = "PX", default_value_t = 1920,
          value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub width: u32,
    /// Its field of view across, in degrees, between 0 and 180.
    #[arg(long, value_name = "DEG", default_value_t = 90.0, value_parser = field_of_view)]
    pub fov: f64,
    /// Write every ray to this CSV file; - is standard output, and the report goes to standard error.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Draw the error along the row to this SVG file, or - as for --csv.
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
}

/// Options of `bake chart`.
#[derive(Debug, Args)]
pub struct ChartArgs {
    /// Directory to write to.
    #[arg(short, long, value_name = "DIR", default_value = "chart")]
    pub output: PathBuf,
    /// Few rays and short timings: seconds, to see that it works.
    #[arg(long)]
    pub quick: bool,
    /// Seed of the random rays.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
}

/// Options of `bake stability`.
#[derive(Debug, Args)]
pub struct StabilityArgs {
    /// Directory to write to.
    #[arg(short, long, value_name = "DIR", default_value = "stability")]
    pub output: PathBuf,
}

fn observer(text: &str) -> Result<Observer, String> {
    if text == "far" {
        return Ok(Observer::far());
    }
    let r: f64 = text
        .parse()
        .map_err(|_| "must be `far` or a radius in units of r_s".to_owned())?;
    Observer::at(r).map_err(|e| e.to_string())
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "is not a number".to_owned())
}

fn positive(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err("must be a positive number".to_owned())
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if (1e-13..=1e-2).contains(&value) {
        Ok(value)
    } else {
        Err("must be from 1e-13 to 1e-2".to_owned())
    }
}

fn field_of_view(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 && value < 180.0 {
        Ok(value)
    } else {
        Err("must be between 0 and 180 degrees".to_owned())
    }
}
