//! A picture file as linear light.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use glam::Vec3;
use image::{DynamicImage, ImageError, ImageReader, Limits, Rgb32FImage, RgbImage};

use super::SkyError;

/// The largest float picture allowed (16384x8192 with alpha) takes 2 GiB; decoders need a copy.
const MAX_DECODER_BYTES: u64 = 4 << 30;

/// A decoded picture. Samples stay in the file's own type until they are looked up, which keeps a
/// large panorama small.
pub(super) struct Picture {
    samples: Samples,
    /// Linear light of each sRGB sample value; empty for samples that are linear already.
    from_srgb: Vec<f32>,
}

enum Samples {
    Srgb8(RgbImage),
    Srgb16(image::ImageBuffer<image::Rgb<u16>, Vec<u16>>),
    Linear(Rgb32FImage),
}

/// Width and height in pixels that the header of the picture file declares.
pub(super) fn dimensions(path: &Path) -> Result<(u32, u32), SkyError> {
    let mut reader = open(path)?;
    // Only the header is read here, so that the caller can name a size that is too large.
    reader.no_limits();
    reader
        .into_dimensions()
        .map_err(|error| not_a_picture(path, error))
}

impl Picture {
    /// Decodes the file. Check its [`dimensions`] first.
    pub(super) fn load(path: &Path) -> Result<Self, SkyError> {
        let mut reader = open(path)?;
        let mut limits = Limits::default();
        limits.max_alloc = Some(MAX_DECODER_BYTES);
        reader.limits(limits);
        let samples = match reader
            .decode()
            .map_err(|error| not_a_picture(path, error))?
        {
            float @ (DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)) => {
                Samples::Linear(checked_light(path, float.into_rgb32f())?)
            }
            deep @ (DynamicImage::ImageLuma16(_)
            | DynamicImage::ImageLumaA16(_)
            | DynamicImage::ImageRgb16(_)
            | DynamicImage::ImageRgba16(_)) => Samples::Srgb16(deep.into_rgb16()),
            other => Samples::Srgb8(other.into_rgb8()),
        };
        let max = match samples {
            Samples::Srgb8(_) => u32::from(u8::MAX),
            Samples::Srgb16(_) => u32::from(u16::MAX),
            Samples::Linear(_) => {
                return Ok(Self {
                    samples,
                    from_srgb: Vec::new(),
                });
            }
        };
        let from_srgb = (0..=max)
            .map(|value| linear_from_srgb(value as f32 / max as f32))
            .collect();
        Ok(Self { samples, from_srgb })
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        match &self.samples {
            Samples::Srgb8(image) => image.dimensions(),
            Samples::Srgb16(image) => image.dimensions(),
            Samples::Linear(image) => image.dimensions(),
        }
    }

    /// Linear RGB light of a pixel; row 0 is the top one.
    pub(super) fn light(&self, column: u32, row: u32) -> Vec3 {
        match &self.samples {
            Samples::Srgb8(image) => image
                .get_pixel(column, row)
                .0
                .map(|value| self.from_srgb[usize::from(value)]),
            Samples::Srgb16(image) => image
                .get_pixel(column, row)
                .0
                .map(|value| self.from_srgb[usize::from(value)]),
            Samples::Linear(image) => image.get_pixel(column, row).0,
        }
        .into()
    }
}

fn open(path: &Path) -> Result<ImageReader<BufReader<File>>, SkyError> {
    // `ImageReader::open` would fall back on the ending of the name.
    File::open(path)
        .and_then(|file| ImageReader::new(BufReader::new(file)).with_guessed_format())
        .map_err(|cause| SkyError::Unreadable {
            path: path.to_owned(),
            cause,
        })
}

fn not_a_picture(path: &Path, error: ImageError) -> SkyError {
    let cause = error
        .to_string()
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    SkyError::NotAPicture {
        path: path.to_owned(),
        cause,
    }
}

/// Returns the picture if each of its samples is finite and not negative.
fn checked_light(path: &Path, image: Rgb32FImage) -> Result<Rgb32FImage, SkyError> {
    let is_light = |value: f32| value.is_finite() && value >= 0.0;
    let width = image.width().max(1) as usize;
    match image.as_raw().iter().position(|&value| !is_light(value)) {
        None => Ok(image),
        Some(index) => Err(SkyError::NotLight {
            path: path.to_owned(),
            column: (index / 3 % width) as u32,
            row: (index / 3 / width) as u32,
            value: image.as_raw()[index],
        }),
    }
}

/// The transfer function of sRGB (IEC 61966-2-1), from 0..1 to linear light 0..1.
fn linear_from_srgb(value: f32) -> f32 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}
