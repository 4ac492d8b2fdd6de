//! A picture file decoded to linear light.

use glam::Vec3;
use image::error::ImageResult;
use image::{DynamicImage, ImageDecoder, ImageFormat, Limits, Rgb32FImage, RgbImage};

use super::file::PictureFile;
use super::{SkyError, memory, openexr};

/// Largest metadata beside the pixels of a picture, bytes: a colour profile, a description.
const MAX_BESIDE: u64 = 256 << 20;
/// Largest size of a decoded pixel, bytes: three floats.
const MAX_PIXEL_BYTES: u64 = 12;

/// A decoded picture. Samples keep the file's type until they are looked up, which keeps a large panorama small.
pub(super) struct DecodedPicture {
    samples: Samples,
    /// Linear light of each sRGB sample value; empty for samples that are linear already.
    from_srgb: Vec<f32>,
}

enum Samples {
    Srgb8(RgbImage),
    Srgb16(image::ImageBuffer<image::Rgb<u16>, Vec<u16>>),
    Linear(Rgb32FImage),
}

impl DecodedPicture {
    /// Decodes the file, whose declared size must have been checked.
    pub(super) fn decode(file: &PictureFile) -> Result<Self, SkyError> {
        if file.format() == ImageFormat::OpenExr {
            let image = openexr::decode(file.bytes()).map_err(|error| file.unusable(error))?;
            return Self::linear(file, image);
        }
        match decoded(file)? {
            float @ (DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)) => {
                Self::linear(file, float.into_rgb32f())
            }
            deep @ (DynamicImage::ImageLuma16(_)
            | DynamicImage::ImageLumaA16(_)
            | DynamicImage::ImageRgb16(_)
            | DynamicImage::ImageRgba16(_)) => Ok(Self::srgb(
                Samples::Srgb16(deep.into_rgb16()),
                u16::MAX.into(),
            )),
            other => Ok(Self::srgb(
                Samples::Srgb8(other.into_rgb8()),
                u8::MAX.into(),
            )),
        }
    }

    fn linear(file: &PictureFile, image: Rgb32FImage) -> Result<Self, SkyError> {
        Ok(Self {
            samples: Samples::Linear(checked_light(file, image)?),
            from_srgb: Vec::new(),
        })
    }

    fn srgb(samples: Samples, max: u32) -> Self {
        let from_srgb = (0..=max)
            .map(|value| linear_from_srgb(value as f32 / max as f32))
            .collect();
        Self { samples, from_srgb }
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

/// The file decoded by the library `image`.
fn decoded(file: &PictureFile) -> Result<DynamicImage, SkyError> {
    let (width, height) = file.size()?;
    let pixels = u64::from(width) * u64::from(height);
    let mut limits = Limits::default();
    limits.max_alloc = Some(pixels * MAX_PIXEL_BYTES + MAX_BESIDE);
    let mut reader = file.reader();
    reader.limits(limits);
    let decoder = file.caught(|| reader.into_decoder())?;
    // The library allocates the pixels once, and some formats as much again while they are decoded.
    memory::check(2 * decoder.total_bytes()).map_err(|error| file.unusable(error))?;
    file.caught(|| -> ImageResult<_> { DynamicImage::from_decoder(decoder) })
}

/// Returns `image` if all of its samples are finite and not negative.
fn checked_light(file: &PictureFile, image: Rgb32FImage) -> Result<Rgb32FImage, SkyError> {
    let is_light = |value: f32| value.is_finite() && value >= 0.0;
    let width = image.width().max(1) as usize;
    match image.as_raw().iter().position(|&value| !is_light(value)) {
        None => Ok(image),
        Some(index) => Err(SkyError::NotLight {
            path: file.path().to_owned(),
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
