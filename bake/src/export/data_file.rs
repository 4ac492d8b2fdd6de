//! The file of the table that a text reads as a texture or an array.

use super::numbers::{Numbers, Precision};
use super::{ExportError, Language, Request};
use exr::math::Vec2;
use exr::prelude::{Encoding, Image, IntoSample, Layer, SpecificChannels, WritableImage};
use half::f16;
use image::{ImageBuffer, ImageFormat, Rgb};
use std::io::Cursor;
use std::path::Path;

/// Format of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DataFormat {
    /// OpenEXR, for floats: R the value, G the slope, B zero.
    Exr,
    /// PNG with 16 bits a channel, for integers.
    Png,
    /// The numbers alone, little-endian: value and slope of each texel, row by row.
    Bin,
}

impl DataFormat {
    /// The format that the extension of `path` names, if it can hold the numbers of `request`.
    ///
    /// # Errors
    /// [`ExportError::DataFormat`] if it names none, or one that cannot.
    pub fn of(path: &Path, request: &Request) -> Result<Self, ExportError> {
        let formats = DataFormat::that_hold(request);
        let extension = path.extension().and_then(|extension| extension.to_str());
        let named = formats
            .iter()
            .find(|format| Some(format.extension()) == extension);
        named.copied().ok_or_else(|| ExportError::DataFormat {
            path: path.to_owned(),
            extensions: formats
                .iter()
                .map(|format| format!(".{}", format.extension()))
                .collect::<Vec<_>>()
                .join(" or "),
        })
    }

    /// The formats that can hold the numbers of `request`, the usual one first.
    pub fn that_hold(request: &Request) -> &'static [DataFormat] {
        match (request.language, request.precision) {
            (Language::Three, _) => &[DataFormat::Bin],
            (_, Precision::Unorm16) => &[DataFormat::Png, DataFormat::Bin],
            (_, Precision::F32 | Precision::F16) => &[DataFormat::Exr, DataFormat::Bin],
        }
    }

    /// Extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            DataFormat::Exr => "exr",
            DataFormat::Png => "png",
            DataFormat::Bin => "bin",
        }
    }

    /// The file of `numbers`, rows of `width` texels. Without `slopes` it holds the values alone.
    ///
    /// # Errors
    /// [`ExportError::Encoding`] if the encoder fails.
    pub fn encode(
        self,
        numbers: &Numbers,
        width: usize,
        slopes: bool,
    ) -> Result<Vec<u8>, ExportError> {
        match self {
            DataFormat::Bin => Ok(numbers.bytes(slopes)),
            DataFormat::Png => png(numbers, width, slopes),
            DataFormat::Exr => openexr(numbers, width, slopes),
        }
    }
}

fn failed(error: impl ToString) -> ExportError {
    ExportError::Encoding(error.to_string())
}

fn png(numbers: &Numbers, width: usize, slopes: bool) -> Result<Vec<u8>, ExportError> {
    let channels = numbers.stored().iter().flat_map(|&[value, slope]| {
        let slope = if slopes { slope } else { 0.0 };
        [value as u16, slope as u16, 0]
    });
    let height = numbers.stored().len() / width;
    let picture: ImageBuffer<Rgb<u16>, Vec<u16>> =
        ImageBuffer::from_raw(width as u32, height as u32, channels.collect())
            .ok_or_else(|| failed("wrong number of texels"))?;
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(failed)?;
    Ok(bytes.into_inner())
}

fn openexr(numbers: &Numbers, width: usize, slopes: bool) -> Result<Vec<u8>, ExportError> {
    match numbers.precision {
        Precision::F16 => openexr_of(numbers, width, slopes, f16::from_f32),
        Precision::F32 | Precision::Unorm16 => openexr_of(numbers, width, slopes, |number| number),
    }
}

/// An OpenEXR file of channels of the type that `as_sample` makes, with scan lines from the top to the bottom: some
/// readers take nothing else.
fn openexr_of<T: IntoSample + Copy>(
    numbers: &Numbers,
    width: usize,
    slopes: bool,
    as_sample: impl Fn(f32) -> T + Sync,
) -> Result<Vec<u8>, ExportError> {
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [value, slope] = numbers.stored()[at.y() * width + at.x()];
        let slope = if slopes { slope } else { 0.0 };
        (as_sample(value), as_sample(slope), as_sample(0.0))
    });
    let size = (width, numbers.stored().len() / width);
    let layer = Layer::new(size, Default::default(), Encoding::SMALL_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(failed)?;
    Ok(bytes.into_inner())
}
