//! The sky behind the hole: a cube map in linear light, procedural or read from pictures.
//!
//! The GPU renderer uploads [`Sky::levels`] and filters in hardware; the CPU renderer filters the same texels with
//! [`Sky::sample`] and [`Sky::sample_level`].
//!
//! The sky frame is right-handed with +Y up. The centre of a panorama lies along −Z and its right half along +X.

use file::PictureFile;
use glam::Vec3;
use std::path::{Path, PathBuf};

mod built_in_stars;
mod cube;
mod decoded;
mod error;
mod faces;
mod file;
mod grid;
mod memory;
mod mip_chain;
mod nebula;
mod noise;
mod noise_lanes;
pub(crate) use noise::hash;
mod openexr;
mod panorama;
mod starmap;

pub use cube::{Cube, face_coordinates, texel_direction};
pub use error::SkyError;
pub use grid::grid;
pub use mip_chain::Sky;
pub use nebula::nebula;
pub use panorama::panorama_uv;
pub use starmap::starmap;

/// Texels along the edge of a face of the built-in skies: 0.11° each at the centre of a face.
pub const BUILT_IN_FACE_TEXELS: u32 = 1024;

/// Where a sky comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SkySource {
    /// Built in: coloured gas clouds and a few stars.
    Nebula,
    /// Built in: a dense field of stars with a Milky Way.
    Starmap,
    /// Built in: circles of latitude and longitude over tinted octants, to judge distortion by eye.
    Grid,
    /// Built in: black, as background for the point stars of [`crate::stars`].
    Stars,
    /// One equirectangular picture, twice as wide as high; see [`load`].
    Panorama(PathBuf),
    /// Six square pictures of one size: right, left, top, bottom, front, back; see [`load`].
    Faces([PathBuf; 6]),
}

impl SkySource {
    /// Whether the sky is built in, not read from files.
    pub fn is_built_in(&self) -> bool {
        matches!(
            self,
            SkySource::Nebula | SkySource::Starmap | SkySource::Grid | SkySource::Stars
        )
    }

    /// The picture files of the sky; none if it is built in.
    pub fn files(&self) -> &[PathBuf] {
        match self {
            SkySource::Panorama(path) => std::slice::from_ref(path),
            SkySource::Faces(paths) => paths,
            SkySource::Nebula | SkySource::Starmap | SkySource::Grid | SkySource::Stars => &[],
        }
    }

    /// The name of the built-in sky, or of the (first) picture file.
    pub fn name(&self) -> String {
        let file = |path: &PathBuf| {
            let name = path.file_name().unwrap_or(path.as_os_str());
            name.to_string_lossy().into_owned()
        };
        match self {
            SkySource::Nebula => "nebula".into(),
            SkySource::Starmap => "starmap".into(),
            SkySource::Grid => "grid".into(),
            SkySource::Stars => "stars".into(),
            SkySource::Panorama(path) => file(path),
            SkySource::Faces(paths) => file(&paths[0]),
        }
    }
}

/// Returns the sky of `source`.
///
/// Pictures may be PNG, JPEG, Radiance HDR or OpenEXR, recognised by content and not by name.
/// Integer samples are taken as sRGB, floating-point samples as linear light; alpha and colour
/// profiles are ignored.
///
/// A panorama has the north pole (+Y) in its top row, −Z in its middle column and +X a quarter turn to the right
/// of that; its aspect ratio may differ from 2:1 by 1 %. The six faces are those of a skybox: right, left, top,
/// bottom, front, back, which are +X, −X, +Y, −Y, +Z, −Z of the left-handed cube map convention. The front is
/// straight ahead, along −Z of the sky frame, and no picture is mirrored.
///
/// # Errors
///
/// A [`SkyError`] names the file that cannot be used, and why. The built-in skies never fail.
pub fn load(source: &SkySource) -> Result<Sky, SkyError> {
    match source {
        SkySource::Nebula => Ok(nebula(BUILT_IN_FACE_TEXELS)),
        SkySource::Starmap => Ok(starmap(BUILT_IN_FACE_TEXELS)),
        SkySource::Grid => Ok(grid(BUILT_IN_FACE_TEXELS)),
        SkySource::Stars => Ok(Sky::from_fn(1, |_| Vec3::ZERO)),
        SkySource::Panorama(path) => panorama::load(PictureFile::read(path)?),
        SkySource::Faces(paths) => faces::load(paths),
    }
}

/// Returns the sky of the panorama file with these `bytes`, as [`load`] does. Errors name `path`, which is not
/// opened.
///
/// # Errors
///
/// A [`SkyError`] says why the bytes cannot be used.
pub fn panorama_from_bytes(path: &Path, bytes: Vec<u8>) -> Result<Sky, SkyError> {
    panorama::load(PictureFile::of(path, bytes)?)
}

/// Returns the width and height in pixels that the header of a picture file declares. Errors name `path`, which is
/// not opened.
///
/// # Errors
///
/// A [`SkyError`] if the header cannot be read.
pub fn declared_size(path: &Path, bytes: Vec<u8>) -> Result<(u32, u32), SkyError> {
    PictureFile::of(path, bytes)?.size()
}

#[cfg(test)]
mod error_tests;
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_skies_are_the_same_each_time_and_shine() {
        for make in [nebula, starmap, grid] {
            for face_texels in [1, 2, 33] {
                let sky = make(face_texels);
                assert_eq!(sky, make(face_texels));
                assert_eq!(sky.face_texels(), face_texels);
            }
            let sky = make(33);
            let texels = sky.levels()[0].texels();
            let light: f32 = texels.iter().map(|texel| texel[1].to_f32()).sum();
            let mean = light / texels.len() as f32;
            assert!((0.005..0.5).contains(&mean), "{mean}");
        }
    }

    #[test]
    fn load_gives_the_built_in_skies_at_their_size() {
        let sky = load(&SkySource::Grid).unwrap();
        assert_eq!(sky.face_texels(), BUILT_IN_FACE_TEXELS);
    }
}
