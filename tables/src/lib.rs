//! The bending table: what its texels hold, how it is looked up, and its files.
//!
//! A [`Table`] is either one row, for one observer, or the atlas: rows for all radii, from which [`Table::row`]
//! interpolates the row of a given observer. A [`Row`] returns the bending Δ (deflection angle) of a ray. The same
//! lookup runs on a GPU: [`lookup::WGSL`].
//!
//! ```
//! use lensbake_core::{RayOutcome, Observer};
//! use lensbake_tables::default_atlas;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let observer = Observer::at(10.0)?;
//! let row = default_atlas().row(observer)?;
//! match row.bend(observer.shadow_coordinate(0.5)) {
//!     RayOutcome::Escapes(bend) => assert!((bend - 0.553_166_226).abs() < 1e-7),
//!     RayOutcome::Captured => unreachable!("0.5 rad is outside the shadow"),
//! }
//! # Ok(())
//! # }
//! ```

mod atlas;
mod axis;
#[cfg(feature = "baking")]
pub mod baking;
#[cfg(feature = "files")]
pub mod container;
mod error;
#[cfg(feature = "files")]
pub mod exr_guard;
mod header;
pub mod interpolation;
pub mod inverse;
pub mod lookup;
pub mod mirror;
#[cfg(feature = "files")]
pub mod panics;
mod row;
mod row_format;
mod rows;
pub mod statistics;
mod table;
#[cfg(feature = "files")]
pub mod text;

pub use atlas::{ATLAS_BINARY, ATLAS_EXR, default_atlas};
pub use axis::{Axis, Stored};
pub use error::TableError;
#[cfg(feature = "files")]
pub use error::{ContainerError, Problem};
pub use header::{Field, Header, Measured, Solver};
pub use interpolation::Interpolation;
pub use inverse::InverseRow;
pub use row::Row;
pub use row_format::{ChannelRanges, RowFormat};
pub use rows::Rows;
pub use table::{Table, Texel};
