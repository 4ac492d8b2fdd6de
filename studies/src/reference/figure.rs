//! The figure: reference, filtered and single-sampled picture side by side at the shadow's edge.

use super::{SampledPicture, Study};
use crate::figure::drawing::{self, DrawError, text};
use glam::DVec3;
use lensbake_render::lens::Lens;
use lensbake_render::picture::{Picture, encode_png};
use plotters::prelude::*;

/// Size of a crop in pixels of the picture, and the factor by which it is enlarged.
const CROP: [u32; 2] = [128, 72];
const ZOOM: u32 = 3;
const GAP: u32 = 12;
/// Height of the line of text above a row of crops.
const LINE: u32 = 30;
const COLUMNS: u32 = 3;

/// A row of the figure: three pictures of a view, a line of text above each, and the lens they are drawn through.
#[derive(Debug)]
pub struct Row<'a> {
    /// The lens.
    pub lens: &'a Lens,
    /// The pictures.
    pub pictures: [&'a Picture; 3],
    /// The lines of text.
    pub texts: [String; 3],
}

impl<'a> From<&'a Study> for Row<'a> {
    fn from(study: &'a Study) -> Self {
        let errors = |what, entry: &SampledPicture| {
            let (whole, edge) = (entry.error.whole.screen, entry.error.beside_edge.screen);
            format!("{what}: off by {whole:.2}/255, at the edge {edge:.2}/255")
        };
        Row {
            lens: &study.lens,
            pictures: [
                &study.reference,
                &study.filtered.picture,
                &study.single.picture,
            ],
            texts: [
                format!("{}: reference", study.case.name),
                errors("filtered", &study.filtered),
                errors("one ray", &study.single),
            ],
        }
    }
}

/// The figure as a PNG file, one row per study.
///
/// # Errors
/// [`DrawError`] if drawing or encoding fails.
pub fn png<'a>(
    studies: impl IntoIterator<Item = impl Into<Row<'a>>>,
) -> Result<Vec<u8>, DrawError> {
    let rows: Vec<Row> = studies.into_iter().map(Into::into).collect();
    let width = GAP + COLUMNS * (CROP[0] * ZOOM + GAP);
    let height = rows.len() as u32 * (LINE + CROP[1] * ZOOM) + GAP;
    let mut canvas = vec![[255_u8; 3]; (width * height) as usize];
    for (index, row) in (0..).zip(&rows) {
        let top = index * (LINE + CROP[1] * ZOOM) + LINE;
        for (column, picture) in (0..).zip(row.pictures) {
            let left = GAP + column * (CROP[0] * ZOOM + GAP);
            draw_crop(&mut canvas, width, [left, top], picture, corner(row.lens));
        }
    }
    let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut canvas);
    draw_text(bytes, (width, height), &rows)?;
    encode_png(width, height, bytes).map_err(DrawError::new)
}

/// The upper left corner of the crop: its middle is on the shadow's edge, to the right of the hole and a little
/// above.
fn corner(lens: &Lens) -> [u32; 2] {
    let camera = &lens.camera;
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
    rows: &[Row],
) -> Result<(), Box<dyn std::error::Error>> {
    drawing::register_font();
    let area = BitMapBackend::with_buffer(canvas, size).into_drawing_area();
    for (index, row) in (0..).zip(rows) {
        for (column, line) in (0..).zip(&row.texts) {
            let x = GAP + column * (CROP[0] * ZOOM + GAP);
            let y = index * (LINE + CROP[1] * ZOOM) + 7;
            area.draw(&Text::new(line.as_str(), (x as i32, y as i32), text(19)))?;
        }
    }
    area.present()?;
    Ok(())
}
