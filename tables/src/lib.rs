//! The bending table: what its texels hold, how it is looked up, and its files.
//!
//! A [`Table`] is one row for one observer, or the atlas: rows for all radii, of which
//! [`Table::row`] mixes the one for the observer at hand. A [`Row`] answers with the bending.
//! The same lookup runs on a GPU: [`lookup::WGSL`].

mod atlas;
mod axis;
pub mod container;
mod error;
mod header;
mod interpolation;
pub mod lookup;
mod row;
pub mod statistics;
mod table;

pub use atlas::{ATLAS_BINARY, ATLAS_EXR, default_atlas};
pub use axis::Axis;
pub use error::{ContainerError, TableError};
pub use header::{Field, Header, Measured, Rows, Solver};
pub use interpolation::Interpolation;
pub use row::Row;
pub use table::{Table, Texel};
