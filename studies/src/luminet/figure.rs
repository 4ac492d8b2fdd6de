//! The figure: three panels, of radius, redshift and flux.

use super::labels::{Label, Line, labels};
use super::{Curve, Curves, Image, Kind};
use crate::figure::PixelBox;
use crate::figure::drawing::{Area, Figure, Ink, text};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// The figure of the curves of a disc.
#[derive(Debug, Clone, Copy)]
pub struct LuminetFigure<'a> {
    /// The curves.
    pub curves: &'a Curves,
    /// Inclination, degrees.
    pub inclination_deg: f64,
}

const MARGIN: i32 = 24;
/// Height of the text above the first panel, and above each one, pixels.
const TITLE: i32 = 66;
const HEAD: i32 = 44;
/// Pixels per M.
const SCALE: f64 = 15.0;
/// What a panel shows, M from the hole: left and right, up, down.
const SIDE: f64 = 34.0;
const UP: f64 = 19.0;
const DOWN: f64 = 14.0;
/// Half of the width of the cross, pixels.
const CROSS: i32 = 7;
/// Radius of the shadow, M.
const SHADOW: f64 = 5.196_152;

const PANELS: [(Kind, &str); 3] = [
    (
        Kind::Radius,
        "images of circles of the radius r/M; dashed: secondary image, of the lower face",
    ),
    (
        Kind::Redshift,
        "redshift z; blue: shifted to higher frequencies, red: to lower ones",
    ),
    (
        Kind::Flux,
        "bolometric flux, in units of the greatest that the disc emits; cross: the brightest point",
    ),
];

impl Figure for LuminetFigure<'_> {
    fn size(&self) -> (u32, u32) {
        let (width, height) = panel_size();
        let all = TITLE + PANELS.len() as i32 * (HEAD + height) + MARGIN;
        ((width + 2 * MARGIN) as u32, all as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        let title = format!(
            "A disc from 6 M to 30 M, seen from afar at an inclination of {}°",
            self.inclination_deg
        );
        area.draw(&Text::new(title, (MARGIN, 22), text(32)))?;
        for (index, (kind, caption)) in (0..).zip(PANELS) {
            let top = TITLE + index * (HEAD + panel_size().1) + HEAD;
            area.draw(&Text::new(caption, (MARGIN, top - 30), text(21)))?;
            let panel = Panel { kind, top };
            panel.draw(area, self.curves)?;
        }
        Ok(())
    }
}

fn panel_size() -> (i32, i32) {
    ((2.0 * SIDE * SCALE) as i32, ((UP + DOWN) * SCALE) as i32)
}

/// A panel, by what its curves show, and its upper edge in the figure.
struct Panel {
    kind: Kind,
    top: i32,
}

impl Panel {
    fn frame(&self) -> PixelBox {
        let (width, height) = panel_size();
        PixelBox {
            left: MARGIN,
            top: self.top,
            right: MARGIN + width,
            bottom: self.top + height,
        }
    }

    fn pixel(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let (right, down) = ((x + SIDE) * SCALE, (UP - y) * SCALE);
        (
            MARGIN + right.round() as i32,
            self.top + down.round() as i32,
        )
    }

    fn draw<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        curves: &Curves,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let PixelBox {
            left,
            top,
            right,
            bottom,
        } = self.frame();
        area.draw(&Rectangle::new(
            [(left, top), (right, bottom)],
            Ink::PALE.stroke_width(2),
        ))?;
        let shadow = (SHADOW * SCALE) as i32;
        area.draw(&Circle::new(
            self.pixel([0.0; 2]),
            shadow,
            Ink::PALE.filled(),
        ))?;
        if self.kind != Kind::Radius {
            for rim in curves.curves.iter().filter(|curve| is_rim(curve)) {
                self.draw_line(area, &rim.points, Ink::GREY.stroke_width(1))?;
            }
        }
        let curves_here = curves.curves.iter().filter(|curve| curve.kind == self.kind);
        let curves_here: Vec<&Curve> = curves_here.collect();
        for curve in &curves_here {
            let style = style(curve);
            if curve.image == Image::Secondary && self.kind == Kind::Radius {
                self.draw_dashes(area, &curve.points, style)?;
            } else {
                self.draw_line(area, &curve.points, style)?;
            }
        }
        let brightest = self.pixel(curves.brightest.place);
        if self.kind == Kind::Flux {
            let red = colour(Kind::Redshift, 1.0).stroke_width(3);
            area.draw(&Cross::new(brightest, CROSS, red))?;
        }
        self.draw_labels(area, &curves_here, brightest)?;
        self.draw_scale(area)
    }

    fn draw_line<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        points: &[[f64; 2]],
        style: ShapeStyle,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let pixels: Vec<(i32, i32)> = points.iter().map(|&point| self.pixel(point)).collect();
        Ok(area.draw(&PathElement::new(pixels, style))?)
    }

    fn draw_dashes<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        points: &[[f64; 2]],
        style: ShapeStyle,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let pixels = points.iter().map(|&point| self.pixel(point));
        Ok(area.draw(&DashedPathElement::new(pixels, 7, 5, style))?)
    }

    /// Draws the values of the curves on them, clear of the brightest point.
    fn draw_labels<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        curves: &[&Curve],
        (x, y): (i32, i32),
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let lines = curves.iter().map(|curve| Line {
            curve,
            pixels: curve
                .points
                .iter()
                .map(|&point| self.pixel(point))
                .collect(),
        });
        let lines: Vec<Line> = lines.collect();
        let cross = PixelBox {
            left: x - CROSS,
            top: y - CROSS,
            right: x + CROSS,
            bottom: y + CROSS,
        };
        let centred = text(19).pos(Pos::new(HPos::Center, VPos::Center));
        for Label { curve, text, frame } in labels(&lines, &self.frame(), vec![cross]) {
            let corners = [(frame.left, frame.top + 1), (frame.right, frame.bottom - 1)];
            area.draw(&Rectangle::new(corners, WHITE.filled()))?;
            let middle = (frame.left + frame.right, frame.top + frame.bottom + 2);
            let middle = (middle.0 / 2, middle.1 / 2);
            let ink = colour(curve.kind, curve.level);
            area.draw(&Text::new(text, middle, centred.color(&ink)))?;
        }
        Ok(())
    }

    /// Draws a bar of 10 M.
    fn draw_scale<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let bar = [[SIDE - 12.0, 1.0 - DOWN], [SIDE - 2.0, 1.0 - DOWN]];
        self.draw_line(area, &bar, Ink::DARK.stroke_width(2))?;
        let above = text(19).pos(Pos::new(HPos::Center, VPos::Bottom));
        let middle = self.pixel([SIDE - 7.0, 1.3 - DOWN]);
        Ok(area.draw(&Text::new("10 M", middle, above))?)
    }
}

/// Whether the curve is a rim of the direct image.
fn is_rim(curve: &Curve) -> bool {
    let ends = [super::RADII_M[0], super::RADII_M[super::RADII_M.len() - 1]];
    curve.kind == Kind::Radius && curve.image == Image::Direct && ends.contains(&curve.level)
}

fn style(curve: &Curve) -> ShapeStyle {
    let width = if curve.image == Image::Direct { 2 } else { 1 };
    colour(curve.kind, curve.level).stroke_width(width)
}

/// Blue for blueshift, red for redshift; all else is dark.
fn colour(kind: Kind, level: f64) -> RGBColor {
    match kind {
        Kind::Redshift if level < 0.0 => RGBColor(9, 105, 218),
        Kind::Redshift if level > 0.0 => RGBColor(207, 34, 46),
        _ => Ink::DARK,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::drawing::svg;
    use crate::luminet::curves;

    #[test]
    fn the_figure_names_all_radii() {
        let figure = LuminetFigure {
            curves: &curves(80f64.to_radians()),
            inclination_deg: 80.0,
        };
        let text = svg(&figure).unwrap();
        for word in ["80°", "\n6\n", "\n30\n", "\n0.9\n", "\n-0.1\n"] {
            assert!(text.contains(word), "{word}");
        }
    }
}
