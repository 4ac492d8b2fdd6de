//! The bending table: what its texels hold, how it is looked up, and its files.
//!
//! A [`Table`] is one row for one observer, or the atlas: rows for all radii, of which
//! [`Table::row`] mixes the one for the observer at hand. A [`Row`] answers with the bending.
//! The same lookup runs on a GPU: [`lookup::WGSL`].
//!
//! ```
//! use lensbake_core::{Fate, Observer};
//! use lensbake_tables::default_atlas;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let observer = Observer::at(10.0)?;
//! let row = default_atlas().row(observer)?;
//! match row.bend(observer.edge_coordinate(0.5)) {
//!     Fate::Escapes(bend) => assert!((bend - 0.553_166_226).abs() < 1e-7),
//!     Fate::Captured => unreachable!("0.5 rad is outside the shadow"),
//! }
//! # Ok(())
//! # }
//! ```

mod atlas;
mod axis;
pub mod container;
mod error;
pub mod exr_guard;
mod header;
mod interpolation;
pub mod inverse;
pub mod lookup;
pub mod output;
pub mod panics;
mod row;
pub mod statistics;
mod table;
pub mod text;

pub use atlas::{ATLAS_BINARY, ATLAS_EXR, default_atlas};
pub use axis::{Axis, Stored};
pub use error::{ContainerError, Problem, TableError};
pub use header::{Field, Header, Measured, Rows, Solver};
pub use interpolation::Interpolation;
pub use inverse::InverseRow;
pub use row::Row;
pub use table::{Table, Texel};
