//! A finished picture in linear light, and its files.

use crate::tone_map::tone_map;
use image::codecs::openexr::OpenExrEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageFormat};
use lensbake_tables::container::{existing_folder, write_whole};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A picture: linear-light RGB, row-major `[height][width]`, row 0 at the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

/// A picture that cannot be written.
#[derive(Debug, Error)]
#[error("{}: {problem}", path.display())]
pub struct PictureError {
    path: PathBuf,
    problem: String,
}

impl PictureError {
    pub(crate) fn new(path: &Path, problem: impl ToString) -> Self {
        PictureError {
            path: path.to_owned(),
            problem: problem.to_string(),
        }
    }
}

impl Picture {
    /// A picture of `pixels`, row-major `[height][width]`.
    ///
    /// # Panics
    /// If their number is not width × height: a fault of the renderer, not of any input.
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Self {
        assert_eq!(pixels.len(), width as usize * height as usize);
        Picture {
            width,
            height,
            pixels,
        }
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

    /// The pixels as a screen shows them: tone mapped at an `exposure` in stops, sRGB, 8 bits a channel.
    pub fn srgb(&self, exposure: f32) -> Vec<[u8; 3]> {
        let shown = |&pixel: &[f32; 3]| tone_map(pixel.into(), exposure).to_array();
        let eight_bits = |linear: f32| (255.0 * srgb_from_linear(linear) + 0.5) as u8;
        self.pixels
            .iter()
            .map(|pixel| shown(pixel).map(eight_bits))
            .collect()
    }

    /// Checks that `path` can become a picture, before any work is done.
    ///
    /// # Errors
    /// [`PictureError`] if its ending is neither .png nor .exr, or its folder does not exist.
    pub fn check_path(path: &Path) -> Result<(), PictureError> {
        format_of(path)?;
        existing_folder(path)
            .map(|_| ())
            .map_err(|e| PictureError::new(path, e))
    }

    /// Writes the picture whole or not at all: .png is what a screen shows at an `exposure` in stops,
    /// .exr is all of the light, linear, in 32-bit floats.
    ///
    /// # Errors
    /// [`PictureError`] names the file and what is wrong.
    pub fn write(&self, path: &Path, exposure: f32) -> Result<(), PictureError> {
        if format_of(path)? == ImageFormat::Png {
            let pixels = self.srgb(exposure);
            return write_png(path, self.width, self.height, bytemuck::cast_slice(&pixels));
        }
        let mut bytes = Vec::new();
        OpenExrEncoder::new(Cursor::new(&mut bytes))
            .write_image(
                bytemuck::cast_slice(&self.pixels),
                self.width,
                self.height,
                ExtendedColorType::Rgb32F,
            )
            .map_err(|e| PictureError::new(path, e))?;
        write_whole(path, &bytes).map_err(|e| PictureError::new(path, e))
    }
}

/// Writes 8-bit sRGB `pixels`, `[height][width][3]`, as PNG, whole or not at all.
pub(crate) fn write_png(
    path: &Path,
    width: u32,
    height: u32,
    pixels: &[u8],
) -> Result<(), PictureError> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(pixels, width, height, ExtendedColorType::Rgb8)
        .map_err(|e| PictureError::new(path, e))?;
    write_whole(path, &bytes).map_err(|e| PictureError::new(path, e))
}

fn format_of(path: &Path) -> Result<ImageFormat, PictureError> {
    match ImageFormat::from_path(path) {
        Ok(format @ (ImageFormat::Png | ImageFormat::OpenExr)) => Ok(format),
        _ => Err(PictureError::new(
            path,
            "the file's ending must be .png or .exr",
        )),
    }
}

/// The sRGB transfer function (IEC 61966-2-1) of linear light, which is clamped to 0 … 1.
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
        assert_eq!(Picture::new(1, 1, vec![[f32::NAN; 3]]).srgb(0.0), [[0; 3]]);
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
    fn both_files_hold_the_picture() {
        let folder = tempfile::tempdir().unwrap();
        let picture = Picture::new(2, 1, vec![[0.0, 0.5, 1.0], [3.0, 0.25, 0.125]]);
        let exr = folder.path().join("p.exr");
        picture.write(&exr, 0.0).unwrap();
        let back = image::open(&exr).unwrap().into_rgb32f();
        assert_eq!(
            back.into_raw(),
            bytemuck::cast_slice::<_, f32>(picture.pixels())
        );
        let png = folder.path().join("p.png");
        picture.write(&png, 0.0).unwrap();
        let back = image::open(&png).unwrap().into_rgb8();
        assert_eq!(
            back.into_raw(),
            bytemuck::cast_slice::<_, u8>(&picture.srgb(0.0))
        );
    }
}
