//! A rendered picture in linear light, and its file formats.

use crate::openexr::{self, Metadata};
use crate::tone_map::tone_map;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError, ImageFormat};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A picture: linear-light RGB, row-major `[height][width]`, row 0 at the top. Every value is finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
    without_value: Option<WithoutValue>,
}

/// Pixels whose light could not be computed. They are black.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WithoutValue {
    /// Number of pixels, at least 1.
    pub count: usize,
    /// (column, row) of the first one.
    pub first: (u32, u32),
}

/// Why a picture cannot be written.
#[derive(Debug, Error)]
pub enum PictureError {
    /// The file extension names no supported format.
    #[error("{}: the file's ending must be {}", path.display(), endings.join(" or "))]
    Ending {
        /// The file.
        path: PathBuf,
        /// The supported file extensions.
        endings: &'static [&'static str],
    },
    /// The encoder failed.
    #[error("the picture cannot be encoded: {0}")]
    Encode(#[from] ImageError),
    /// The encoder of OpenEXR files failed.
    #[error("the picture cannot be encoded: {0}")]
    EncodeOpenExr(#[from] exr::error::Error),
}

/// A file format for pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFormat {
    /// 8-bit sRGB, tone mapped: what a screen shows.
    Png,
    /// The full range of linear light, in 32-bit floats.
    OpenExr,
}

impl PictureFormat {
    /// The format for the file extension of `path`; PNG for `-`, standard output.
    ///
    /// # Errors
    /// [`PictureError::Ending`] if the extension is not that of one of `formats`.
    pub fn of(path: &Path, formats: &'static [PictureFormat]) -> Result<Self, PictureError> {
        let asked = match ImageFormat::from_path(path) {
            _ if path == Path::new("-") => Some(PictureFormat::Png),
            Ok(ImageFormat::Png) => Some(PictureFormat::Png),
            Ok(ImageFormat::OpenExr) => Some(PictureFormat::OpenExr),
            _ => None,
        };
        asked
            .filter(|format| formats.contains(format))
            .ok_or_else(|| PictureError::Ending {
                path: path.to_owned(),
                endings: if formats == Self::ALL {
                    &[".png", ".exr"]
                } else {
                    &[".png"]
                },
            })
    }

    /// All formats.
    pub const ALL: &'static [PictureFormat] = &[PictureFormat::Png, PictureFormat::OpenExr];
}

impl Picture {
    /// A picture of `pixels`, row-major `[height][width]`. Pixels that are not finite become black and are counted
    /// by [`Picture::without_value`].
    ///
    /// # Panics
    /// If the number of pixels is not width × height, which is a bug in the renderer.
    pub fn new(width: u32, height: u32, mut pixels: Vec<[f32; 3]>) -> Self {
        assert_eq!(pixels.len(), width as usize * height as usize);
        let mut without_value: Option<WithoutValue> = None;
        for (index, pixel) in pixels.iter_mut().enumerate() {
            if pixel.iter().all(|channel| channel.is_finite()) {
                continue;
            }
            *pixel = [0.0; 3];
            let place = (index as u32 % width, index as u32 / width);
            let first = without_value.map_or(place, |lost| lost.first);
            let count = without_value.map_or(0, |lost| lost.count) + 1;
            without_value = Some(WithoutValue { count, first });
        }
        Picture {
            width,
            height,
            pixels,
            without_value,
        }
    }

    /// A black picture.
    pub fn black(width: u32, height: u32) -> Self {
        Picture::new(
            width,
            height,
            vec![[0.0; 3]; width as usize * height as usize],
        )
    }

    /// The pixels whose light could not be computed, if any.
    pub fn without_value(&self) -> Option<WithoutValue> {
        self.without_value
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The pixels, row-major `[height][width]`.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// Adds `light` to the pixel at (column, row).
    ///
    /// # Panics
    /// If the picture has no such pixel.
    pub fn add(&mut self, column: u32, row: u32, light: [f32; 3]) {
        let pixel = &mut self.pixels[row as usize * self.width as usize + column as usize];
        for (channel, more) in pixel.iter_mut().zip(light) {
            *channel += more;
        }
    }

    /// Multiplies each pixel by `share(column, row)`, which is not called for black pixels.
    pub fn cover(&mut self, share: impl Fn(u32, u32) -> f32 + Sync) {
        let width = self.width as usize;
        let rows = self.pixels.par_chunks_mut(width).zip(0..self.height);
        rows.for_each(|(pixels, row)| {
            let lit = (0..).zip(pixels).filter(|(_, pixel)| **pixel != [0.0; 3]);
            for (column, pixel) in lit {
                *pixel = pixel.map(|channel| channel * share(column, row));
            }
        });
    }

    /// Adds the light of `other`, a picture of the same size. Pixels without value of either are black in it.
    ///
    /// # Panics
    /// If the sizes differ.
    pub fn add_picture(&mut self, other: &Picture) {
        assert_eq!((self.width, self.height), (other.width, other.height));
        for (pixel, more) in self.pixels.iter_mut().zip(&other.pixels) {
            for (channel, more) in pixel.iter_mut().zip(more) {
                *channel += more;
            }
        }
        self.without_value = self.without_value.or(other.without_value);
    }

    /// Multiplies all light by `factor`.
    pub fn scale(&mut self, factor: f32) {
        for channel in self.pixels.iter_mut().flatten() {
            *channel *= factor;
        }
    }

    /// The pixels as a screen shows them: tone mapped at an `exposure` in stops, sRGB, 8 bits per channel.
    pub fn srgb(&self, exposure: f32) -> Vec<[u8; 3]> {
        let shown = |&pixel: &[f32; 3]| tone_map(pixel.into(), exposure).to_array();
        let eight_bits = |linear: f32| (255.0 * srgb_from_linear(linear) + 0.5) as u8;
        self.pixels
            .par_iter()
            .map(|pixel| shown(pixel).map(eight_bits))
            .collect()
    }

    /// Encodes the picture as a file. A PNG is tone mapped at an `exposure` in stops. [`openexr::encode`] also writes
    /// layers and metadata.
    ///
    /// # Errors
    /// [`PictureError::Encode`] or [`PictureError::EncodeOpenExr`] if the encoder fails.
    pub fn encode(&self, format: PictureFormat, exposure: f32) -> Result<Vec<u8>, PictureError> {
        match format {
            PictureFormat::Png => {
                let pixels = self.srgb(exposure);
                encode_png(self.width, self.height, bytemuck::cast_slice(&pixels))
            }
            PictureFormat::OpenExr => openexr::encode(self, Vec::new(), &Metadata::default()),
        }
    }
}

/// Encodes 8-bit sRGB `pixels`, `[height][width][3]`, as a PNG file.
///
/// # Errors
/// [`PictureError::Encode`] if the encoder fails.
pub fn encode_png(width: u32, height: u32, pixels: &[u8]) -> Result<Vec<u8>, PictureError> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(pixels, width, height, ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

/// The sRGB transfer function (IEC 61966-2-1) of linear light, clamped to 0 … 1.
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_has_its_known_values() {
        let known = [
            (0.0, 0.0),
            (1.0, 1.0),
            (2.0, 1.0),
            (-1.0, 0.0),
            (0.214_041, 0.5),
        ];
        for (linear, expected) in known {
            assert!(
                (srgb_from_linear(linear) - expected).abs() < 1e-5,
                "{linear}"
            );
        }
    }

    #[test]
    fn a_screen_shows_what_is_too_bright_for_it() {
        let picture = Picture::new(3, 1, vec![[0.0, 0.5, 0.8], [3.0, 1.5, 0.0], [0.1; 3]]);
        let [dark, bright, _] = picture.srgb(0.0)[..] else {
            panic!("three pixels")
        };
        assert_eq!(dark, [0, 188, 231]);
        assert!(
            bright[0] > 250 && bright[1] < 190 && bright[2] == 0,
            "{bright:?}"
        );
        assert_eq!(picture.srgb(-1.0)[0], [0, 137, 170]);
    }

    #[test]
    fn light_of_pictures_adds_up() {
        let mut sum = Picture::new(2, 1, vec![[1.0, 2.0, 3.0], [0.5; 3]]);
        sum.add_picture(&Picture::new(2, 1, vec![[1.0; 3], [f32::NAN; 3]]));
        sum.scale(0.5);
        assert_eq!(sum.pixels(), [[1.0, 1.5, 2.0], [0.25; 3]]);
        let lost = sum.without_value().unwrap();
        assert_eq!((lost.count, lost.first), (1, (1, 0)));
    }

    fn write(picture: &Picture, path: &Path) {
        let format = PictureFormat::of(path, PictureFormat::ALL).unwrap();
        std::fs::write(path, picture.encode(format, 0.0).unwrap()).unwrap();
    }

    #[test]
    fn both_files_hold_the_picture() {
        let folder = tempfile::tempdir().unwrap();
        let picture = Picture::new(2, 1, vec![[0.0, 0.5, 1.0], [3.0, 0.25, 0.125]]);
        let exr = folder.path().join("p.exr");
        write(&picture, &exr);
        let back = image::open(&exr).unwrap().into_rgb32f();
        assert_eq!(
            back.into_raw(),
            bytemuck::cast_slice::<_, f32>(picture.pixels())
        );
        let png = folder.path().join("p.png");
        write(&picture, &png);
        let back = image::open(&png).unwrap().into_rgb8();
        assert_eq!(
            back.into_raw(),
            bytemuck::cast_slice::<_, u8>(&picture.srgb(0.0))
        );
    }
}
