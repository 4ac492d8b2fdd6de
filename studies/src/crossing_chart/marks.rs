//! Marks in the plane of the chart, and their legend.

use crate::crossing_methods::Kind;
use crate::figure::PixelBox;
use crate::figure::drawing::{Area, Ink, text};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// Height of a row of the legend, pixels.
const ROW: i32 = 34;
/// Rows of the legend: the kinds of method, what is used, the arithmetic, the front.
const ROWS: i32 = Kind::ALL.len() as i32 + 3;

/// The box of the legend whose lower right corner is this pixel.
pub const fn legend_box((right, bottom): (i32, i32)) -> PixelBox {
    PixelBox {
        left: right - 464,
        top: bottom - ROWS * ROW - 10,
        right,
        bottom,
    }
}

/// The colour of a kind of method.
pub fn colour(kind: Kind) -> RGBColor {
    match kind {
        Kind::Weierstrass => RGBColor(207, 34, 46),
        Kind::Jacobi => RGBColor(26, 127, 55),
        Kind::Table => RGBColor(188, 76, 0),
        Kind::Integrated => RGBColor(9, 105, 218),
    }
}

fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Weierstrass => "closed form in Weierstrass' function",
        Kind::Jacobi => "closed form in Jacobi's sn and cn",
        Kind::Table => "tables, 32 × 16 to 512 × 256 texels",
        Kind::Integrated => "integrations from infinity",
    }
}

/// The line of the Pareto front.
pub fn front_style() -> ShapeStyle {
    Ink::DARK.mix(0.55).stroke_width(3)
}

/// A mark: filled for f32, a ring for f64, larger for what is used.
pub fn draw_mark<DB: DrawingBackend>(
    area: &Area<DB>,
    kind: Kind,
    used: bool,
    bits: usize,
    at: (i32, i32),
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let radius = if used { 13 } else { 8 };
    area.draw(&Circle::new(at, radius + 2, WHITE.filled()))?;
    let style = match bits {
        32 => colour(kind).filled(),
        _ => colour(kind).stroke_width(4),
    };
    area.draw(&Circle::new(at, radius, style))?;
    Ok(())
}

/// Draws the legend in its box.
pub fn draw_legend<DB: DrawingBackend>(
    area: &Area<DB>,
    frame: PixelBox,
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let corners = [(frame.left, frame.top), (frame.right, frame.bottom)];
    area.draw(&Rectangle::new(corners, WHITE.filled()))?;
    area.draw(&Rectangle::new(corners, Ink::PALE.stroke_width(2)))?;
    let style = text(22).pos(Pos::new(HPos::Left, VPos::Center));
    let place = |row: i32| (frame.left + 34, frame.top + 26 + ROW * row);
    let row_name = |row: i32, name: &'static str| {
        let (x, y) = place(row);
        Text::new(name, (x + 32, y), style.clone())
    };
    for (row, kind) in (0..).zip(Kind::ALL) {
        draw_mark(area, kind, false, 32, place(row))?;
        area.draw(&row_name(row, name(kind)))?;
    }
    let rows = Kind::ALL.len() as i32;
    draw_mark(area, Kind::Weierstrass, true, 32, place(rows))?;
    area.draw(&row_name(rows, "large: used by this project"))?;
    draw_mark(area, Kind::Weierstrass, false, 64, place(rows + 1))?;
    area.draw(&row_name(rows + 1, "ring: in f64; filled: in f32"))?;
    let (x, y) = place(rows + 2);
    area.draw(&PathElement::new(
        vec![(x - 20, y), (x + 20, y)],
        front_style(),
    ))?;
    area.draw(&row_name(rows + 2, "Pareto front: beaten by none in both"))?;
    Ok(())
}
