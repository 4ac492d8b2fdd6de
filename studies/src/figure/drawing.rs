//! A figure drawn once for each format.

use super::font;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::error::Error;

pub use super::font::register as register_font;

/// An area to draw on.
pub type Area<DB> = DrawingArea<DB, Shift>;

/// A figure that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("a figure cannot be drawn: {0}")]
pub struct DrawError(String);

impl DrawError {
    /// With what a library says.
    pub fn new(problem: impl ToString) -> Self {
        DrawError(problem.to_string())
    }
}

impl From<Box<dyn Error>> for DrawError {
    fn from(problem: Box<dyn Error>) -> Self {
        DrawError::new(problem)
    }
}

/// Something that can be drawn with any backend.
pub trait Figure {
    /// Width and height, pixels.
    fn size(&self) -> (u32, u32);

    /// Draws it on an area of that size.
    ///
    /// # Errors
    /// What the drawing library says.
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static;
}

/// The figure as an SVG document.
///
/// # Errors
/// [`DrawError`] with what the drawing library says.
pub fn svg(figure: &impl Figure) -> Result<String, DrawError> {
    font::register();
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, figure.size()).into_drawing_area();
        figure.draw(&area)?;
        area.present().map_err(DrawError::new)?;
    }
    Ok(text)
}

/// The figure as a PNG file.
///
/// # Errors
/// [`DrawError`] with what the drawing or the image library says.
pub fn png(figure: &impl Figure) -> Result<Vec<u8>, DrawError> {
    font::register();
    let (width, height) = figure.size();
    let mut pixels = vec![0; 3 * width as usize * height as usize];
    {
        let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
        figure.draw(&area)?;
        area.present().map_err(DrawError::new)?;
    }
    let mut file = Vec::new();
    let best = CompressionType::Best;
    PngEncoder::new_with_quality(&mut file, best, FilterType::NoFilter)
        .write_image(&pixels, width, height, ExtendedColorType::Rgb8)
        .map_err(DrawError::new)?;
    Ok(file)
}

/// The colours that all figures share; drawn on white, they are read on light and dark pages.
pub struct Ink;

impl Ink {
    /// Text and frames.
    pub const DARK: RGBColor = RGBColor(31, 35, 40);
    /// Leaders and secondary text.
    pub const GREY: RGBColor = RGBColor(101, 109, 118);
    /// Grids.
    pub const PALE: RGBColor = RGBColor(228, 231, 235);
}

/// Text of this size, in pixels.
pub fn text(size: i32) -> TextStyle<'static> {
    TextStyle::from((font::FAMILY, size).into_font()).color(&Ink::DARK)
}
