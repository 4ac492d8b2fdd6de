//! Marks in the plane of the chart, the curves through them, and their labels.

use super::MeasuredMethod;
use crate::figure::drawing::{Area, Ink, text};
use crate::figure::{Labels, PixelBox};
use crate::methods::Family;
use plotters::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;

/// The kinds of method that differ in mark and colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The default row.
    Default,
    /// Tables of a residual.
    Residual,
    /// Tables of the bending itself.
    Naive,
    /// Closed forms.
    Closed,
    /// Integrators.
    Direct,
    /// The observer treated as if at infinity: exact bending for the wrong observer.
    Model,
}

impl Kind {
    /// All kinds, in the legend's order.
    pub const ALL: [Kind; 6] = [
        Kind::Default,
        Kind::Residual,
        Kind::Naive,
        Kind::Closed,
        Kind::Direct,
        Kind::Model,
    ];

    /// The kind of `entry`.
    pub fn of(entry: &MeasuredMethod) -> Self {
        match entry.info.family {
            Family::Table if entry.info.name.starts_with("lensbake") => Kind::Default,
            Family::Table if entry.info.name.contains("residual") => Kind::Residual,
            Family::Table => Kind::Naive,
            Family::Closed => Kind::Closed,
            Family::Direct => Kind::Direct,
            Family::Model => Kind::Model,
        }
    }

    fn colour(self) -> RGBColor {
        match self {
            Kind::Default => RGBColor(207, 34, 46),
            Kind::Residual => RGBColor(225, 111, 36),
            Kind::Naive => RGBColor(140, 149, 159),
            Kind::Closed => RGBColor(26, 127, 55),
            Kind::Direct => RGBColor(9, 105, 218),
            Kind::Model => RGBColor(130, 80, 223),
        }
    }

    /// The colour of labels, dark enough to read.
    fn ink(self) -> RGBColor {
        match self {
            Kind::Naive => Ink::GREY,
            Kind::Residual => RGBColor(188, 76, 0),
            _ => self.colour(),
        }
    }
}

/// A measured method at its pixel.
pub struct Mark<'a> {
    /// The measured method.
    pub entry: &'a MeasuredMethod,
    /// Kind of method.
    pub kind: Kind,
    /// Position, pixels.
    pub at: (i32, i32),
    /// Text of the label, if any.
    pub label: Option<String>,
}

/// Draws a thin line through the marks of each method, along its parameter values; tables have none.
pub fn draw_curves<DB: DrawingBackend>(
    area: &Area<DB>,
    marks: &[Mark],
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let mut curves: BTreeMap<&str, Vec<&Mark>> = BTreeMap::new();
    for mark in marks
        .iter()
        .filter(|m| m.entry.info.family != Family::Table)
    {
        curves.entry(&mark.entry.info.name).or_default().push(mark);
    }
    for curve in curves.values_mut() {
        curve.sort_by_key(|mark| mark.at);
        let colour = curve[0].kind.colour().mix(0.5).stroke_width(2);
        let points: Vec<_> = curve.iter().map(|mark| mark.at).collect();
        area.draw(&PathElement::new(points, colour))?;
    }
    Ok(())
}

/// Draws the mark of `kind` at a pixel.
pub fn draw_mark<DB: DrawingBackend>(
    area: &Area<DB>,
    kind: Kind,
    at: (i32, i32),
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let solid = kind.colour().filled();
    match kind {
        Kind::Default => {
            area.draw(&Circle::new(at, 15, WHITE.filled()))?;
            area.draw(&Circle::new(at, 13, solid))?;
        }
        Kind::Residual | Kind::Naive => area.draw(&Circle::new(at, 4, solid))?,
        Kind::Direct => area.draw(&Circle::new(at, 8, solid))?,
        Kind::Closed => {
            let (x, y) = at;
            let diamond = vec![(x - 10, y), (x, y - 10), (x + 10, y), (x, y + 10)];
            area.draw(&Polygon::new(diamond, solid))?;
        }
        Kind::Model => area.draw(&TriangleMarker::new(at, 11, solid))?,
    }
    Ok(())
}

/// A label and its position.
pub struct Label<'a> {
    mark: &'a Mark<'a>,
    text: &'a str,
    size: i32,
    frame: PixelBox,
}

/// Finds positions for the labels of `marks`; a label that fits nowhere is left out.
pub fn place_labels<'a, DB: DrawingBackend>(
    area: &Area<DB>,
    labels: &mut Labels,
    marks: &'a [Mark],
) -> Result<Vec<Label<'a>>, Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let mut placed = Vec::new();
    for mark in marks {
        let Some(label) = &mark.label else { continue };
        let size = if mark.kind == Kind::Default { 30 } else { 24 };
        let (width, height) = area.estimate_text_size(label, &text(size))?;
        if let Some(frame) = labels.place(mark.at, (width as i32 + 8, height as i32 + 6)) {
            placed.push(Label {
                mark,
                text: label,
                size,
                frame,
            });
        }
    }
    Ok(placed)
}

impl Label<'_> {
    /// Draws the line to the mark, and the background of the text.
    pub fn draw_ground<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let line = self.mark.kind.colour().mix(0.6).stroke_width(1);
        let ends = vec![self.mark.at, self.frame.nearest_to(self.mark.at)];
        area.draw(&PathElement::new(ends, line))?;
        let PixelBox {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let ground = WHITE.mix(0.8).filled();
        area.draw(&Rectangle::new([(left, top), (right, bottom)], ground))?;
        Ok(())
    }

    /// Draws the text.
    pub fn draw_text<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let ink = self.mark.kind.ink();
        let place = (self.frame.left + 4, self.frame.top + 3);
        area.draw(&Text::new(self.text, place, text(self.size).color(&ink)))?;
        Ok(())
    }
}
