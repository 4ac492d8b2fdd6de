//! Heat map of the image-space error of each pixel, on a logarithmic colour scale with a key.

use crate::figure::drawing::{self, DrawError, text};
use lensbake_render::diff::PixelError;
use lensbake_render::picture::encode_png;
use plotters::prelude::*;

/// Range of the colour scale: exponents of ten of the error in pixels.
const DECADES: std::ops::Range<i32> = -6..0;
/// Height of the key below the map, and the width that the key needs at least, pixels.
const KEY: u32 = 104;
const MIN_WIDTH: u32 = 640;
const MARGIN: i32 = 28;

const BOTH_CAPTURED: [u8; 3] = [0, 0, 0];
const OUTCOMES_DIFFER: [u8; 3] = [255, 0, 255];
const NO_VALUE: [u8; 3] = [255, 255, 255];

/// The heat map of `errors`, row-major `[height][width]`, as a PNG file with the title `what`.
///
/// # Errors
/// [`DrawError`] if drawing or encoding fails.
pub fn png(width: u32, errors: &[PixelError], what: &str) -> Result<Vec<u8>, DrawError> {
    let height = (errors.len() / width as usize) as u32;
    let full = width.max(MIN_WIDTH);
    let mut canvas = vec![[255_u8; 3]; full as usize * (height + KEY) as usize];
    for (row, line) in errors.chunks_exact(width as usize).enumerate() {
        let start = row * full as usize;
        for (pixel, error) in canvas[start..].iter_mut().zip(line) {
            *pixel = colour(error);
        }
    }
    let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut canvas);
    draw_key(bytes, (full, height + KEY), what)?;
    encode_png(full, height + KEY, bytes).map_err(DrawError::new)
}

fn colour(error: &PixelError) -> [u8; 3] {
    match *error {
        PixelError::OutcomesDiffer { .. } => OUTCOMES_DIFFER,
        PixelError::BothCaptured => BOTH_CAPTURED,
        PixelError::NoValue => NO_VALUE,
        PixelError::BothEscape { pixels, .. } => scale(pixels.log10()),
    }
}

/// The colour of an error of 10^`exponent` pixels.
fn scale(exponent: f64) -> [u8; 3] {
    let span = f64::from(DECADES.end - DECADES.start);
    let t = (exponent - f64::from(DECADES.start)) / span;
    let RGBColor(r, g, b) = ViridisRGB::get_color(t.clamp(0.0, 1.0));
    [r, g, b]
}

fn draw_key(
    canvas: &mut [u8],
    (width, height): (u32, u32),
    what: &str,
) -> Result<(), Box<dyn std::error::Error>> {
    drawing::register_font();
    let top = (height - KEY) as i32;
    let strip = width as i32 - 2 * MARGIN;
    let area = BitMapBackend::with_buffer(canvas, (width, height)).into_drawing_area();
    area.draw(&Text::new(what.to_owned(), (MARGIN, top + 8), text(20)))?;
    let caption =
        "pixels in image space; black: both captured, magenta: outcomes differ, white: no value";
    area.draw(&Text::new(caption, (MARGIN, top + 30), text(18)))?;
    for x in 0..strip {
        let t = f64::from(x) / f64::from(strip);
        let exponent = f64::from(DECADES.start) + t * f64::from(DECADES.end - DECADES.start);
        let [r, g, b] = scale(exponent);
        let (left, upper, lower) = (MARGIN + x, top + 56, top + 76);
        area.draw(&Rectangle::new(
            [(left, upper), (left + 1, lower)],
            RGBColor(r, g, b).filled(),
        ))?;
    }
    let decades = DECADES.end - DECADES.start;
    for decade in 0..=decades {
        let x = MARGIN + strip * decade / decades;
        let label = format!("1e{}", DECADES.start + decade);
        area.draw(&Text::new(label, (x - 14, top + 80), text(18)))?;
    }
    area.present()?;
    Ok(())
}
