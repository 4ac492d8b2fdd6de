//! The figure: reference, filtered and single-sampled picture side by side at the shadow's edge.

use super::{SampledPicture, Study};
use crate::figure::drawing::{self, DrawError, text};
use glam::DVec3;
use lensbake_render::picture::{Picture, encode_png};
use plotters::prelude::*;

/// Size of a crop in pixels of the picture, and the factor by which it is enlarged.
const CROP: [u32; 2] = [128, 72];
const ZOOM: u32 = 3;
const GAP: u32 = 12;
/// Height of the line of text above a row of crops.
const LINE: u32 = 30;
const COLUMNS: u32 = 3;

/// The figure of `studies` as a PNG file, one row per study.
///
/// # Errors
/// [`DrawError`] if drawing or encoding fails.
pub fn png(studies: &[Study]) -> Result<Vec<u8>, DrawError> {
    let width = GAP + COLUMNS * (CROP[0] * ZOOM + GAP);
    let height = studies.len() as u32 * (LINE + CROP[1] * ZOOM) + GAP;
    let mut canvas = vec![[255_u8; 3]; (width * height) as usize];
    for (row, study) in (0..).zip(studies) {
        let top = row * (LINE + CROP[1] * ZOOM) + LINE;
        let pictures = [
            &study.reference,
            &study.filtered.picture,
            &study.single.picture,
        ];
        for (column, picture) in (0..).zip(pictures) {
            let left = GAP + column * (CROP[0] * ZOOM + GAP);
            draw_crop(&mut canvas, width, [left, top], picture, corner(study));
        }
    }
    let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut canvas);
    draw_text(bytes, (width, height), studies)?;
    encode_png(width, height, bytes).map_err(DrawError::new)
}

/// The upper left corner of the crop: its middle is on the shadow's edge, to the right of the hole and a little
/// above.
fn corner(study: &Study) -> [u32; 2] {
    let camera = &study.lens.camera;
    let (sin, cos) = camera.observer.shadow_angle().sin_cos();
    let edge = |turn: f64| DVec3::new(sin * turn.cos(), sin * turn.sin(), -cos);
    let (column, row) = camera
        .pixel(camera.boosted(edge(0.3)).0)
        .or_else(|| camera.pixel(camera.boosted(edge(0.0)).0))
        .unwrap_or((camera.width / 2, camera.height / 2));
    let first = |middle: u32, crop: u32, size: u32| {
        middle
            .saturating_sub(crop / 2)
            .min(size.saturating_sub(crop))
    };
    [
        first(column, CROP[0], camera.width),
        first(row, CROP[1], camera.height),
    ]
}

fn draw_crop(
    canvas: &mut [[u8; 3]],
    width: u32,
    at: [u32; 2],
    picture: &Picture,
    corner: [u32; 2],
) {
    let pixels = picture.srgb(0.0);
    for y in 0..CROP[1] * ZOOM {
        for x in 0..CROP[0] * ZOOM {
            let (column, row) = (corner[0] + x / ZOOM, corner[1] + y / ZOOM);
            if column < picture.width() && row < picture.height() {
                canvas[((at[1] + y) * width + at[0] + x) as usize] =
                    pixels[(row * picture.width() + column) as usize];
            }
        }
    }
}

fn draw_text(
    canvas: &mut [u8],
    size: (u32, u32),
    studies: &[Study],
) -> Result<(), Box<dyn std::error::Error>> {
    drawing::register_font();
    let area = BitMapBackend::with_buffer(canvas, size).into_drawing_area();
    for (row, study) in (0..).zip(studies) {
        let errors = |what, entry: &SampledPicture| {
            let (whole, edge) = (entry.error.whole.screen, entry.error.beside_edge.screen);
            format!("{what}: off by {whole:.2}/255, at the edge {edge:.2}/255")
        };
        let texts = [
            format!("{}: reference", study.case.name),
            errors("filtered", &study.filtered),
            errors("one ray", &study.single),
        ];
        for (column, line) in (0..).zip(texts) {
            let x = GAP + column * (CROP[0] * ZOOM + GAP);
            let y = row * (LINE + CROP[1] * ZOOM) + 7;
            area.draw(&Text::new(line, (x as i32, y as i32), text(19)))?;
        }
    }
    area.present()?;
    Ok(())
}
