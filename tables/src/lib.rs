//! The bending table: what its texels hold, how it is looked up, and its files.
//!
//! A [`Table`] is either one row, for one observer, or the atlas: rows for all radii, from which [`Table::row`]
//! interpolates the row of a given observer. A [`Row`] returns the bending Δ (deflection angle) of a ray. The same
//! lookup runs on a GPU: [`lookup::WGSL`].
//!
//! ```
//! use lensbake_core::{Observer, RayOutcome};
//! use lensbake_tables::default_atlas;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let observer = Observer::at(10.0)?; // at rest, ten Schwarzschild radii from the hole
//! let row = default_atlas().row(observer)?; // interpolated between four rows of the atlas
//! match row.bend(observer.shadow_coordinate(0.5)) {
//!     // 0.5 rad from the direction of the hole
//!     RayOutcome::Escapes(bend) => assert!((bend - 0.553_166_226).abs() < 1e-7),
//!     RayOutcome::Captured => unreachable!("0.5 rad is outside the shadow"),
//! }
//! # Ok(())
//! # }
//! ```
//!
//! A picture is a lookup for each pixel. Here is a sky in squares of 15° by 45° around the direction of the hole, in a
//! picture 90° across:
//!
//! ```
//! # use lensbake_core::{Observer, RayOutcome};
//! # use lensbake_tables::default_atlas;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let observer = Observer::at(10.0)?;
//! let row = default_atlas().row(observer)?;
//! let mut picture = String::new();
//! for line in 0..23 {
//!     for column in 0..78 {
//!         // The picture is 2 units wide at distance 1; a character is twice as high as wide.
//!         let (x, y) = ((f64::from(column) - 38.5) / 39.0, (11.0 - f64::from(line)) / 19.5);
//!         let theta = x.hypot(y).atan();
//!         picture.push(match row.bend(observer.shadow_coordinate(theta)) {
//!             RayOutcome::Captured => '#',
//!             RayOutcome::Escapes(bend) => {
//!                 let sky = (theta - bend).to_degrees(); // in the plane of the ray, negative beyond the hole
//!                 let azimuth = y.atan2(x).to_degrees();
//!                 let square = (sky / 15.0).floor() + (azimuth / 45.0).floor();
//!                 if square.rem_euclid(2.0) == 1.0 { '.' } else { ' ' }
//!             }
//!         });
//!     }
//!     picture.push('\n');
//! }
//! println!("{picture}");
//! # assert_eq!(picture.matches('#').count(), 152);
//! # Ok(())
//! # }
//! ```
//!
//! ```text
//! .....            ...               ....    ...............   ............
//! ....              .          ..........          .......... ..............
//! ..              .....     ............ .            .....     ..............
//! ..            .................        ........                 ............
//! .            .........   ...     ......      .....   ...         ............
//!             ........      .  ...   ....    ...   .. ......        ............
//!            ........     ...  . .. .... .    .  . ..   .....        ...........
//!            .......     ...  . ...############   . ..   .....       ...........
//!           .......     ...  .  .################ .. ..   .....       ..........
//!           .......    ...  .   ##################... ..   ....       ..........
//!           .......    ... ....####################    .   ....       ..........
//! ..........       ....   . . .####################. . .   ....       ..........
//! ..........       ....   .    ####################.... ...    .......
//! ..........       ....   .. ...##################   .  ...    .......
//! ..........       .....   .. .. ################.  .  ...     .......
//! ...........       .....   .. .   ############... .  ...     .......
//! ...........        .....   .. .  .    . .... .. .  ...     ........
//! ............        ...... ..   ...    ....   ...  .      ........
//!  ............         ...   .....      ......     ...   .........            .
//!   ............                 ........        .................            ..
//!   ..............     .....            . ............     .....              ..
//!     .............. ..........          ..........          .              ....
//!      ............   ...............    ....               ...            .....
//! ```
//!
//! Elsewhere than in Rust, take a text of `bake export`: the lookup for shaders, Blender, Python and C.

mod atlas;
mod axis;
#[cfg(feature = "baking")]
pub mod baking;
pub mod batch;
#[cfg(feature = "files")]
pub mod container;
mod error;
#[cfg(feature = "files")]
pub mod exr_attributes;
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
pub mod stereographic;
mod table;
#[cfg(feature = "files")]
pub mod text;

pub use atlas::{ATLAS_BINARY, ATLAS_EXR, default_atlas};
pub use axis::{Axis, Stored};
pub use batch::{RowBatch, RowBatchF32};
pub use error::TableError;
#[cfg(feature = "files")]
pub use error::{ContainerError, Problem};
pub use header::{Field, Header, Measured, Solver};
pub use interpolation::Interpolation;
pub use inverse::InverseRow;
pub use row::Row;
pub use row_format::{ChannelRanges, RowFormat};
pub use rows::Rows;
pub use stereographic::StereographicRow;
pub use table::{Table, Texel};
