//! Point stars in front of the sky: catalogues, and the images of the stars as the hole lenses them.
//!
//! A star is never a texel of the sky. The inverse row gives the view direction and the magnification of each
//! image of a star ([`images`]). A star on the optical axis, the line through hole and camera, is drawn as the arc
//! or ring that it is ([`aligned`]). An image is drawn at its sub-pixel position with a point-spread kernel whose
//! weights add up to one at every position ([`kernel`]). [`draw`](mod@draw) does this on the CPU in f64,
//! `shaders/list_stars.wgsl` on the GPU.
//!
//! Sky angles are equatorial, J2000: +Y of the sky frame is the north celestial pole, right ascension 0 lies along
//! −Z and grows towards −X, to the left as seen from inside.

pub mod aligned;
mod catalogue;
pub mod cells;
pub(crate) mod colour;
mod compact;
mod csv;
pub mod draw;
mod error;
mod field;
mod frustum;
mod hipparcos;
pub mod image_bounds;
pub mod images;
pub mod kernel;
mod lines;
mod sorted;
mod splat;

pub use catalogue::{Catalogue, DEFAULT_DISC_RADIUS, MAX_DISC_RADIUS, MAX_STARS, Star, direction};
pub use colour::{light_of_colour_index, temperature};
pub use compact::{from_bytes, to_bytes};
pub use draw::draw;
pub use error::{StarsError, StarsProblem};
pub use field::{LIGHT_AT_MAGNITUDE_0, PointStar, StarField};
pub use hipparcos::{hipparcos, read_hipparcos};
pub use sorted::SortedStars;
pub use splat::Splat;

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The source of a star catalogue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StarSource {
    /// The built-in Hipparcos catalogue.
    Hipparcos,
    /// A user's file: CSV, or the compact format of `docs/stars.md`.
    File(PathBuf),
}

/// Largest catalogue file that is read, bytes.
const MAX_BYTES: u64 = 1 << 28;

/// Loads the catalogue of `source`. The format of a file is recognised by its content.
///
/// # Errors
/// [`StarsError`] names the file and says what is wrong with it. The built-in catalogue never fails.
pub fn load(source: &StarSource) -> Result<Catalogue, StarsError> {
    match source {
        StarSource::Hipparcos => Ok(hipparcos()),
        StarSource::File(path) => {
            let bytes = read(path)?;
            catalogue_from_bytes(&bytes).map_err(|problem| StarsError::new(path, problem))
        }
    }
}

/// Decodes the bytes of a catalogue file of either format.
///
/// # Errors
/// [`StarsProblem`] says what is wrong with `bytes`.
pub fn catalogue_from_bytes(bytes: &[u8]) -> Result<Catalogue, StarsProblem> {
    if compact::is_compact(bytes) {
        from_bytes(bytes)
    } else {
        csv::read(bytes)
    }
}

/// Reads the bytes of a catalogue file.
///
/// # Errors
/// [`StarsError`] if the file cannot be read or is larger than 256 MiB.
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
