//! The command line.

mod values;

pub use values::Radii;

use ::bake::export::{Language, Mode, Precision};
use clap::{Args, Parser, Subcommand, ValueEnum};
use lensbake_core::{Motion, Observer};
use std::path::PathBuf;
use values::{
    angle, field_of_view, finite_radius, function_name, observer, positive, radii, tolerance,
    visible_inclination,
};

/// Bake the bending of light (deflection angle) by a black hole into a table, and check it.
///
/// Without a command, bakes a table; without any argument, the atlas for all observers. Lengths are in units of
/// the Schwarzschild radius. Exit code 0: done, 1: a budget was missed, 2: bad usage or input.
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
    /// Copy a table into the container that the second file's extension names: .lbt or .exr.
    Convert {
        /// The table to read.
        from: PathBuf,
        /// The table to write; - writes a .lbt to standard output.
        to: PathBuf,
    },
    /// Write the lookup as a text in another language, for a shader or a program of your own.
    ///
    /// With --observer, the text holds the row of that observer and needs nothing else. Without, it serves all observers
    /// at rest and reads a table from a file, which is written beside it. The comment at its top says what it takes and
    /// returns, and how large its error is.
    Export(ExportArgs),
    /// Read lines `R THETA_DEG [AZIMUTH_DEG]` or `inf B [AZIMUTH_DEG]` from standard input; for each, print the bending in
    /// radians or `captured`.
    ///
    /// R is the observer's radius, THETA_DEG the view angle from the direction of the hole in degrees, in the
    /// observer's own frame, AZIMUTH_DEG the azimuth about that direction from the direction of motion (0 if it is not
    /// given), counter-clockwise as the observer sees it, and B the impact parameter of a ray from infinity. Lengths are in
    /// units of the Schwarzschild radius. The bending is THETA minus the angle on the sky. Each answer is printed without
    /// waiting for the next line.
    ///
    /// With --disc, print where the ray crosses a thin disc instead: `RADIUS ORDER SHIFT` for each crossing, all on one
    /// line, in the order in which the ray traced from the observer meets them, or `-` if it does not meet the disc. The
    /// order is the number of half turns about the hole before the crossing: 0 in the direct image, 1 in the second. The
    /// shift is the frequency at the observer over that at which the matter emits. There are two crossings at most.
    Query(QueryArgs),
    /// Compare a table, between its nodes, with the direct integrator and with the closed form.
    Diff(DiffArgs),
    /// Chart speed against accuracy: every method on the same rays, in one run.
    ///
    /// Writes chart.csv, and chart-px and chart-rad as SVG and PNG. Exit code 1 if a method beats the default row:
    /// its largest error is smaller, it is faster by more than the noise of the run, and it needs no more bytes
    /// per frame. With --disc, charts the ways to find where a ray crosses a disc instead, and writes crossings.csv, and
    /// crossings as SVG and PNG.
    Chart(ChartArgs),
    /// Try every method in every regime: at the shadow's edge, at the horizon and below, in fast motion, with no ray
    /// at all.
    ///
    /// Writes atlas.csv, and as SVG and PNG atlas (observers at rest) and atlas-motion (observers in motion). Exit
    /// code 1 if one of this project's own methods is wrong (below the horizon, the table by more than it promises),
    /// or answers an input that is not a ray instead of refusing it.
    Stability(StabilityArgs),
    /// Draw a thin disc as an observer far away sees it, by curves of constant radius, redshift and flux: Luminet's
    /// picture of 1979.
    ///
    /// Writes luminet.csv, and luminet as SVG and PNG, and prints the brightest point and what the paper states in
    /// numbers beside ours.
    Luminet(LuminetArgs),
}

/// What to bake.
#[derive(Debug, Args)]
pub struct BakeArgs {
    /// File to write: .lbt (binary), .exr (OpenEXR), or - for a .lbt on standard output. Can be given more than
    /// once.
    #[arg(short, long, value_name = "FILE", default_value = "atlas.lbt")]
    pub output: Vec<PathBuf>,
    /// Bake one row, for the observer at this radius (from 0.001, or `far`), instead of the atlas.
    #[arg(long, value_name = "far|R", value_parser = observer)]
    pub observer: Option<Observer>,
    /// Texels per row [default: 64 for the residual axis, 1024 for the others].
    #[arg(long, value_name = "N")]
    pub texels: Option<u32>,
    /// Rows of the atlas above the horizon [default: 128].
    #[arg(long, value_name = "N", conflicts_with = "observer")]
    pub rows: Option<u32>,
    /// Rows of the atlas below the horizon, down to r = 0.01; 0 for none [default: 64].
    #[arg(long, value_name = "N", conflicts_with = "observer")]
    pub rows_below: Option<u32>,
    /// Error tolerance of the integrator, in rad per radian of orbital angle, from 1e-13 to 1e-2.
    #[arg(long, value_name = "RAD", default_value_t = 1e-9, value_parser = tolerance)]
    pub tolerance: f64,
    /// Axis along the row. Every axis but `residual` is naive and holds only the row of the observer at infinity.
    #[arg(long, value_enum, default_value_t = AxisName::Residual)]
    pub axis: AxisName,
    /// Smallest impact parameter of a naive axis.
    #[arg(long, value_name = "B", default_value_t = 2.598_1, requires = "axis")]
    pub b_min: f64,
    /// Largest impact parameter of a naive axis.
    #[arg(long, value_name = "B", default_value_t = 100.0, requires = "axis")]
    pub b_max: f64,
    /// Largest measured error allowed, in rad; above it nothing is written and the exit code is 1. Of an atlas, that of
    /// the rows above the horizon.
    #[arg(long, value_name = "RAD", value_parser = positive)]
    pub budget: Option<f64>,
    /// The same for the rows below the horizon of an atlas.
    #[arg(long, value_name = "RAD", value_parser = positive)]
    pub budget_below: Option<f64>,
    /// Number of threads [default: one per core]. It does not change the bytes written.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// The axes of a table, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AxisName {
    /// The residual against q = √(1−√x), x being the normalised shadow coordinate: this project's own axis.
    Residual,
    /// Uniform in the impact parameter b.
    B,
    /// Uniform in 1/b.
    InverseB,
    /// Uniform in ln(b/b_c − 1), b_c being the critical impact parameter.
    LogB,
}

/// How the observer of an exported text moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Frame {
    /// At rest.
    Rest,
    /// In free fall from rest at infinity.
    Fall,
}

/// How to compute a bending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Look it up in the table.
    Lut,
    /// Integrate by RK4.
    Rk4,
    /// Evaluate the closed form.
    Exact,
}

/// Options of `bake export`.
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// The language.
    #[arg(long, value_enum, value_name = "LANGUAGE")]
    pub to: Language,
    /// Radius of the one observer that the text is for, in units of the Schwarzschild radius: above 1 at rest, from 0.01
    /// in free fall.
    #[arg(long, value_name = "R", value_parser = finite_radius)]
    pub observer: Option<f64>,
    /// How that observer moves: at rest, or freely, from rest at infinity.
    #[arg(long, value_enum, default_value_t = Frame::Rest, requires = "observer")]
    pub motion: Frame,
    /// How a text for all observers looks up the table.
    #[arg(long, value_enum, default_value_t = Mode::Row, conflicts_with = "observer")]
    pub mode: Mode,
    /// Texels per row.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(4..=4096))]
    pub texels: u32,
    /// Format of the numbers [default: f16 for --mode simple, f32 otherwise].
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Name of the function; other names in the text begin with it.
    #[arg(long, value_name = "NAME", default_value = "lensbake", value_parser = function_name)]
    pub function: String,
    /// File to write, or - for standard output [default: the name of the function with the language's extension].
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// File of the table: .exr (f32, f16), .png (unorm16), or .bin (the numbers alone) [default: beside the text, .bin
    /// for three, otherwise .exr or .png].
    #[arg(long, value_name = "FILE", conflicts_with = "observer")]
    pub data: Option<PathBuf>,
    /// Write the last row first, for programs that put v = 0 at the lowest line of a picture (Unity, OpenGL).
    #[arg(long, conflicts_with = "observer")]
    pub flip: bool,
}

/// Options of `bake query`.
#[derive(Debug, Args)]
pub struct QueryArgs {
    /// Table for `lut` [default: the built-in atlas].
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// How to compute the bending.
    #[arg(long, value_enum, default_value_t = MethodName::Lut)]
    pub method: MethodName,
    /// How the observer moves: `rest`, `fall` (freely, from rest at infinity), `orbit` (circular, r > 1.5), or a
    /// velocity BR,BT in units of c: radial (positive outwards) and tangential, relative to the observer at rest, at
    /// the horizon and below to the observer in free fall.
    #[arg(
        long,
        value_name = "rest|fall|orbit|BR,BT",
        default_value = "rest",
        allow_hyphen_values = true
    )]
    pub motion: Motion,
    /// Print `THETA_SKY AZIMUTH SHIFT` instead of the bending: the angle on the sky from the direction of the hole, not
    /// reduced to 0 to pi, and the azimuth, in radians, and the frequency shift, observed over emitted.
    #[arg(long)]
    pub sky: bool,
    /// Print the crossings with a disc of these radii instead of the bending: from 3, the innermost stable orbit, to 1e6.
    /// Its matter is on circular orbits, counter-clockwise as seen from its axis [without a value: 3,12].
    #[arg(
        long,
        value_name = "R_IN,R_OUT",
        num_args = 0..=1,
        default_missing_value = "3,12",
        value_parser = radii,
        conflicts_with = "sky"
    )]
    pub disc: Option<Radii>,
    /// Angle of the disc's axis from the line from the hole to the observer, degrees: 0 shows the disc face-on, 90 edge-on.
    #[arg(long, value_name = "DEG", default_value_t = 80.0, value_parser = angle,
          allow_negative_numbers = true, requires = "disc")]
    pub inclination: f64,
    /// Azimuth of the line of nodes, about which the disc is inclined, degrees. The axis is then at the azimuth
    /// NODE + 90: at 0 the near side of the disc is at the azimuth -90 and moves towards the azimuth 0.
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = angle,
          allow_negative_numbers = true, requires = "disc")]
    pub node: f64,
    /// Error tolerance of RK4, in rad per radian of orbital angle, from 1e-13 to 1e-2.
    #[arg(long, value_name = "RAD", default_value_t = 1e-12, value_parser = tolerance)]
    pub tolerance: f64,
}

/// Options of `bake diff`.
#[derive(Debug, Args)]
pub struct DiffArgs {
    /// The table [default: the built-in atlas].
    pub file: Option<PathBuf>,
    /// How the observers of the rays move: `rest`, `fall` (freely, from rest at infinity; half of them below the
    /// horizon), `orbit` (circular, r > 1.5), or a velocity BR,BT in units of c relative to the observer at rest:
    /// radial (positive outwards) and tangential.
    #[arg(
        long,
        value_name = "rest|fall|orbit|BR,BT",
        default_value = "rest",
        allow_hyphen_values = true
    )]
    pub motion: Motion,
    /// Number of random rays off the nodes; half of them crowd the shadow's edge, the others fill the sky outside it
    /// as the observer sees it.
    #[arg(long, value_name = "N", default_value_t = 100_000,
          value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    pub rays: u32,
    /// Seed of the random rays.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Error tolerance of the direct integrator, in rad per radian of orbital angle.
    #[arg(long, value_name = "RAD", default_value_t = 1e-11, value_parser = tolerance)]
    pub tolerance: f64,
    /// Largest error allowed against the closed form, in rad; above it, or if the outcome of any ray differs, the exit
    /// code is 1.
    #[arg(long, value_name = "RAD", default_value_t = 2e-6, value_parser = positive)]
    pub budget: f64,
    /// The same for observers in motion below r = 0.1.
    #[arg(long, value_name = "RAD", default_value_t = 3e-5, value_parser = positive)]
    pub budget_deep: f64,
    /// Largest image-space error allowed, in pixels, of observers in motion down to r = 0.1; above it the exit code
    /// is 1.
    #[arg(long, value_name = "PX", default_value_t = 0.002, value_parser = positive)]
    pub budget_px: f64,
    /// Width of the picture whose pixels are the unit of image-space errors.
    #[arg(long, value_name = "PX", default_value_t = 1920,
          value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub width: u32,
    /// Horizontal field of view of that picture, in degrees, between 0 and 180.
    #[arg(long, value_name = "DEG", default_value_t = 90.0, value_parser = field_of_view)]
    pub fov: f64,
    /// Write one line per ray to this CSV file, with angles in the observer's own frame. With - it goes to standard
    /// output, and the report to standard error.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Draw the error along the row to this SVG file; - as for --csv.
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
}

/// Options of `bake chart`.
#[derive(Debug, Args)]
pub struct ChartArgs {
    /// Directory to write to.
    #[arg(short, long, value_name = "DIR", default_value = "chart")]
    pub output: PathBuf,
    /// Use few rays and short timings: takes seconds, only checks that the command works.
    #[arg(long)]
    pub quick: bool,
    /// Chart the methods that find the radius at which a ray crosses a disc.
    #[arg(long)]
    pub disc: bool,
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

/// Options of `bake luminet`.
#[derive(Debug, Args)]
pub struct LuminetArgs {
    /// Directory to write to.
    #[arg(short, long, value_name = "DIR", default_value = "disc")]
    pub output: PathBuf,
    /// Angle of the disc's axis from the line of sight, from 1 to 89.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 80.0,
        allow_negative_numbers = true,
        value_parser = visible_inclination
    )]
    pub inclination: f64,
}
