//! The figure: error in image space against time per ray, log–log, with the Pareto front.

use super::{Chart, Family, MeasuredDeflection};
use crate::figure::drawing::{Area, Figure, Ink, text};
use crate::figure::{Labels, LogAxis, PixelBox, Plane, Ticks};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

const SIZE: (u32, u32) = (1600, 1000);
const FRAME: PixelBox = PixelBox {
    left: 150,
    top: 150,
    right: 1560,
    bottom: 870,
};
const LEGEND: PixelBox = PixelBox {
    left: FRAME.right - 350,
    top: FRAME.top + 24,
    right: FRAME.right - 10,
    bottom: FRAME.top + 56 + 38 * Family::ALL.len() as i32,
};
/// Room left on either side of the times for labels, as a factor.
const ROOM: f64 = 2.0;
/// An error of 0 is drawn here: f32 has none that small.
const MIN_ERROR: f64 = 1e-9;
/// Distance between the points of a line that labels should not hide, pixels.
const DENSITY: f64 = 12.0;
/// From the middle of a line of text to what looks like its middle, pixels.
const LETTERS: i32 = 4;

/// The figure of a chart.
#[derive(Debug)]
pub struct ChartFigure<'a>(pub &'a Chart);

impl Figure for ChartFigure<'_> {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        draw(self.0, area)
    }
}

/// A method at its pixel.
struct Mark<'a> {
    entry: &'a MeasuredDeflection,
    at: (i32, i32),
    /// The ends of the bar that shows the spread of its time.
    bar: [(i32, i32); 2],
}

impl<'a> Mark<'a> {
    fn new(entry: &'a MeasuredDeflection, plane: &Plane) -> Self {
        let (time, error) = (entry.times.best(), entry.errors.pixels.max);
        let spread = time.spread.min(0.9);
        let end = |sign: f64| plane.at(time.ns * (1.0 + sign * spread), error);
        Mark {
            entry,
            at: plane.at(time.ns, error),
            bar: [end(-1.0), end(1.0)],
        }
    }
}

fn draw<DB: DrawingBackend>(chart: &Chart, area: &Area<DB>) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    area.fill(&WHITE)?;
    draw_title(chart, area)?;
    let point = |entry: &MeasuredDeflection| (entry.ns(), entry.errors.pixels.max);
    let points: Vec<_> = chart.entries.iter().map(point).collect();
    let plane = plane_around(&points);
    let clock = if chart.entries.iter().all(|e| e.times.gpu.is_some()) {
        "time per ray by the device's timestamps, ns"
    } else {
        "time per ray by the wall clock, ns"
    };
    plane.draw(area, clock, "largest error in image space, pixels")?;
    plane.draw_front(area, &points, FRONT.stroke_width(6))?;
    let marks = |family| -> Vec<Mark> {
        let of_family = chart.entries.iter().filter(|entry| entry.family == family);
        of_family.map(|entry| Mark::new(entry, &plane)).collect()
    };
    let families = Family::ALL.map(|family| (family, marks(family)));
    let hidden_by_labels = families.iter().flat_map(|(_, marks)| drawn_points(marks));
    let mut labels = Labels::new(FRAME, hidden_by_labels.collect());
    labels.keep_free(LEGEND);
    for (family, marks) in &families {
        draw_family(area, *family, marks)?;
    }
    for (family, marks) in &families {
        draw_labels(area, *family, marks, &mut labels)?;
    }
    draw_legend(area)?;
    area.present()?;
    Ok(())
}

fn draw_title<DB: DrawingBackend>(chart: &Chart, area: &Area<DB>) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let (width, height) = chart.size;
    let title = format!("One frame on {}", chart.adapter);
    area.draw(&Text::new(title, (FRAME.left, 26), text(36)))?;
    let kind = if chart.software {
        " — drawn by the CPU: no GPU's times"
    } else {
        ""
    };
    let subtitle = format!(
        "{width} × {height}, camera at r = {}, median of {} rounds{kind}",
        chart.radius, chart.rounds
    );
    area.draw(&Text::new(
        subtitle,
        (FRAME.left, 78),
        text(28).color(&Ink::GREY),
    ))?;
    Ok(())
}

/// The plane that holds all points (time, error): whole decades of the error.
fn plane_around(points: &[(f64, f64)]) -> Plane {
    let range = |of: fn(&(f64, f64)) -> f64| {
        let values = points.iter().map(of).filter(|v| v.is_finite() && *v > 0.0);
        values.fold((f64::MAX, f64::MIN_POSITIVE), |(least, most), v| {
            (least.min(v), most.max(v))
        })
    };
    let (fastest, slowest) = range(|p| p.0);
    let (least, most) = range(|p| p.1.max(MIN_ERROR));
    let decades = 10f64.powf(least.log10().floor())..=10f64.powf(most.log10().ceil());
    Plane {
        frame: FRAME,
        cost: LogAxis::new(fastest / ROOM..=slowest * ROOM, Ticks::OneTwoFive),
        error: LogAxis::new(decades, Ticks::Decades(1)),
    }
}

fn draw_family<DB: DrawingBackend>(
    area: &Area<DB>,
    family: Family,
    marks: &[Mark],
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let colour = colour(family);
    let way: Vec<_> = marks.iter().map(|mark| mark.at).collect();
    area.draw(&PathElement::new(way, colour.stroke_width(2)))?;
    for mark in marks {
        area.draw(&PathElement::new(mark.bar.to_vec(), colour.stroke_width(4)))?;
        draw_mark(area, family, mark.at)?;
    }
    Ok(())
}

/// Points along the bars of a family and along the line through its marks.
fn drawn_points(marks: &[Mark]) -> Vec<(i32, i32)> {
    let bars = marks.iter().map(|mark| mark.bar);
    let line = marks.windows(2).map(|pair| [pair[0].at, pair[1].at]);
    bars.chain(line).flat_map(points_between).collect()
}

fn points_between([from, to]: [(i32, i32); 2]) -> impl Iterator<Item = (i32, i32)> {
    let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
    let parts = (dx.hypot(dy) / DENSITY).ceil().max(1.0);
    (0..=parts as u32).map(move |i| {
        let t = f64::from(i) / parts;
        (from.0 + (t * dx) as i32, from.1 + (t * dy) as i32)
    })
}

fn draw_mark<DB: DrawingBackend>(
    area: &Area<DB>,
    family: Family,
    at: (i32, i32),
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let style = colour(family).filled();
    match family {
        Family::Hermite => area.draw(&Circle::new(at, 9, style))?,
        Family::Format => area.draw(&Cross::new(at, 9, colour(family).stroke_width(4)))?,
        Family::Linear => area.draw(&TriangleMarker::new(at, 12, style))?,
        Family::Direct => {
            let (x, y) = at;
            let diamond = vec![(x - 12, y), (x, y - 12), (x + 12, y), (x, y + 12)];
            area.draw(&Polygon::new(diamond, style))?;
        }
        Family::Flat => {
            let (x, y) = at;
            area.draw(&Rectangle::new([(x - 9, y - 9), (x + 9, y + 9)], style))?;
        }
        Family::Falling => area.draw(&Circle::new(at, 10, colour(family).stroke_width(4)))?,
        Family::Drawing => {
            let (x, y) = at;
            let square = [(x - 9, y - 9), (x + 9, y + 9)];
            area.draw(&Rectangle::new(square, colour(family).stroke_width(4)))?;
        }
    }
    Ok(())
}

/// The labels of a family near its marks, with a line to each. A label that fits nowhere is left out.
fn draw_labels<DB: DrawingBackend>(
    area: &Area<DB>,
    family: Family,
    marks: &[Mark],
    labels: &mut Labels,
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let colour = colour(family);
    let style = text(26).color(&colour);
    for mark in marks {
        let name = mark.entry.name.as_str();
        let (width, height) = area.estimate_text_size(name, &style)?;
        let size = (width as i32 + 8, height as i32 + 4);
        let Some(frame) = labels.place(mark.at, size) else {
            continue;
        };
        let leader = vec![mark.at, frame.nearest_to(mark.at)];
        area.draw(&PathElement::new(leader, colour.stroke_width(1)))?;
        let corners = [(frame.left, frame.top), (frame.right, frame.bottom)];
        area.draw(&Rectangle::new(corners, WHITE.mix(0.8).filled()))?;
        let place = (frame.left + 4, frame.top + 2 + LETTERS);
        area.draw(&Text::new(name, place, style.clone()))?;
    }
    Ok(())
}

fn draw_legend<DB: DrawingBackend>(area: &Area<DB>) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let (left, top) = (LEGEND.left + 20, LEGEND.top);
    let style = text(26).pos(Pos::new(HPos::Left, VPos::Center));
    for (line, family) in Family::ALL.into_iter().enumerate() {
        let y = top + 16 + 38 * line as i32;
        draw_mark(area, family, (left, y))?;
        area.draw(&Text::new(
            family.name(),
            (left + 30, y + LETTERS),
            style.clone(),
        ))?;
    }
    let y = top + 16 + 38 * Family::ALL.len() as i32;
    let way = vec![(left - 14, y), (left + 14, y)];
    area.draw(&PathElement::new(way, FRONT.stroke_width(6)))?;
    area.draw(&Text::new(
        "no method beats these",
        (left + 30, y + LETTERS),
        style,
    ))?;
    Ok(())
}

const FRONT: RGBColor = RGBColor(184, 218, 190);

fn colour(family: Family) -> RGBColor {
    match family {
        Family::Hermite => RGBColor(207, 34, 46),
        Family::Format => RGBColor(191, 57, 137),
        Family::Linear => RGBColor(188, 76, 0),
        Family::Direct => RGBColor(9, 105, 218),
        Family::Flat => Ink::DARK,
        Family::Falling => RGBColor(130, 80, 223),
        Family::Drawing => RGBColor(45, 125, 110),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_holds_all_points() {
        let plane = plane_around(&[(4.0, 2e-4), (400.0, 300.0)]);
        let (left, low) = plane.at(4.0, 2e-4);
        let (right, high) = plane.at(400.0, 300.0);
        assert!(FRAME.left < left && right < FRAME.right);
        assert!(low < FRAME.bottom && high > FRAME.top);
        let (middle, _) = plane.at(40.0, 1.0);
        assert!((middle - (left + right) / 2).abs() <= 1);
        assert_eq!(plane.at(40.0, 0.0).1, FRAME.bottom);
        assert_eq!(plane.at(40.0, f64::INFINITY).1, FRAME.top);
    }

    #[test]
    fn lines_are_points_close_together() {
        let points: Vec<_> = points_between([(0, 0), (30, 40)]).collect();
        assert_eq!(points.first(), Some(&(0, 0)));
        assert_eq!(points.last(), Some(&(30, 40)));
        assert_eq!(points.len(), 6);
        assert_eq!(points_between([(5, 5), (5, 5)]).count(), 2);
    }
}
