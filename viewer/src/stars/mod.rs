//! Point stars before the sky: catalogues, and their images as the hole makes them.
//!
//! A star is never a texel. For each star the inverse row says where it is seen ([`images`]) and how
//! much brighter; a star on the axis through hole and camera is drawn as the arc or ring that it is
//! ([`aligned`]). An image is drawn at its place between the pixels with a kernel whose sum is one
//! wherever it falls ([`kernel`]). [`draw`](mod@draw) does this on the CPU in f64, `shaders/stars.wgsl`
//! on the GPU.
//!
//! Sky angles are equatorial, J2000: +Y of the sky frame is the north celestial pole, right ascension 0
//! lies along −Z and grows towards −X, to the left as seen from inside.

pub mod aligned;
mod catalogue;
pub mod cells;
mod colour;
mod compact;
mod csv;
pub mod draw;
mod error;
mod field;
mod hipparcos;
pub mod images;
pub mod kernel;
mod lines;
pub mod ways;

pub use catalogue::{Catalogue, DEFAULT_DISC_RADIUS, MAX_DISC_RADIUS, MAX_STARS, Star, direction};
pub use colour::{light_of_colour_index, temperature};
pub use compact::{from_bytes, to_bytes};
pub use draw::draw;
pub use error::{StarsError, StarsProblem};
pub use field::{LIGHT_AT_MAGNITUDE_0, PointStar, StarField};
pub use hipparcos::{hipparcos, read_hipparcos};

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Where stars come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StarSource {
    /// Built in: the Hipparcos catalogue.
    Hipparcos,
    /// A person's own: CSV, or the compact format of `docs/stars.md`.
    File(PathBuf),
}

/// The largest catalogue file that is read, bytes.
const MAX_BYTES: u64 = 1 << 28;

/// The catalogue of `source`. A file is recognised by its content.
///
/// # Errors
/// A [`StarsError`] names the file and says what is wrong with it. The built-in catalogue never fails.
pub fn load(source: &StarSource) -> Result<Catalogue, StarsError> {
    match source {
        StarSource::Hipparcos => Ok(hipparcos()),
        StarSource::File(path) => {
            let bytes = read(path)?;
            catalogue_from_bytes(&bytes).map_err(|problem| StarsError::new(path, problem))
        }
    }
}

/// The catalogue in the bytes of a file of either format.
///
/// # Errors
/// A [`StarsProblem`] says what is wrong with them.
pub fn catalogue_from_bytes(bytes: &[u8]) -> Result<Catalogue, StarsProblem> {
    if compact::is_compact(bytes) {
        from_bytes(bytes)
    } else {
        csv::read(bytes)
    }
}

/// The bytes of a catalogue file.
///
/// # Errors
/// A [`StarsError`] if it cannot be read or is larger than any catalogue should be.
pub fn read(path: &Path) -> Result<Vec<u8>, StarsError> {
    let whole = || {
        let mut bytes = Vec::new();
        fs::File::open(path)?
            .take(MAX_BYTES + 1)
            .read_to_end(&mut bytes)?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(StarsProblem::TooLarge { max: MAX_BYTES });
        }
        Ok(bytes)
    };
    whole().map_err(|problem| StarsError::new(path, problem))
}
