//! The figure: error in image space against time per crossing, log–log, with the Pareto front.

use super::marks::{colour, draw_legend, draw_mark, front_style, legend_box};
use super::{CrossingChart, MeasuredCrossing};
use crate::crossing_methods::{CrossingInfo, Kind};
use crate::figure::drawing::{Area, Figure, Ink, text};
use crate::figure::{Labels, LogAxis, PixelBox, Plane, Ticks};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// The figure of a chart.
#[derive(Debug, Clone, Copy)]
pub struct CrossingFigure<'a>(pub &'a CrossingChart);

const SIZE: (u32, u32) = (1600, 1100);
const FRAME: PixelBox = PixelBox {
    left: 150,
    top: 120,
    right: 1560,
    bottom: 1000,
};
/// In a part of the plane where no method is.
const LEGEND: PixelBox = legend_box((FRAME.right - 16, FRAME.bottom - 140));
/// Distance between the points of a line that labels should not hide, pixels.
const DENSITY: i32 = 14;

/// The error that is drawn: the largest, in pixels.
fn point(entry: &MeasuredCrossing) -> (f64, f64) {
    (entry.time.ns, entry.errors.pixels.max)
}

impl Figure for CrossingFigure<'_> {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        draw_title(area, self.0.entries.len())?;
        let plane = Plane {
            frame: FRAME,
            cost: LogAxis::new(1.0..=2e3, Ticks::Times),
            error: LogAxis::new(1e-10..=1e4, Ticks::Decades(2)),
        };
        plane.draw(
            area,
            "time per crossing on one CPU thread",
            "largest error in image space, pixels",
        )?;
        let points: Vec<_> = self.0.entries.iter().map(point).collect();
        plane.draw_front(area, &points, front_style())?;
        let mut labels = Labels::new(FRAME, self.obstacles(&plane));
        labels.keep_free(LEGEND);
        for (error, name) in self.levels() {
            labels.keep_free(draw_level(area, &plane, error, name)?);
        }
        let at = |entry: &MeasuredCrossing| plane.at(point(entry).0, point(entry).1);
        self.draw_curves(area, at)?;
        for entry in self.0.entries.iter().rev() {
            draw_mark(
                area,
                entry.info.kind,
                entry.info.used,
                entry.bits,
                at(entry),
            )?;
        }
        draw_legend(area, LEGEND)?;
        self.draw_labels(area, at, &mut labels)
    }
}

impl CrossingFigure<'_> {
    /// Errors that have a line of their own, and its name.
    fn levels(&self) -> [(f64, &'static str); 2] {
        [
            (0.1, "0.1 pixel: less is not seen"),
            (self.0.rounding.pixels.max, "inputs rounded to f32"),
        ]
    }

    /// What labels should not hide: the marks, and points along the lines.
    fn obstacles(&self, plane: &Plane) -> Vec<(i32, i32)> {
        let at = |entry: &MeasuredCrossing| plane.at(point(entry).0, point(entry).1);
        let between = |((x, y), (to_x, to_y)): ((i32, i32), (i32, i32))| {
            let parts = 1 + (to_x - x).abs().max((to_y - y).abs()) / DENSITY;
            (0..parts).map(move |i| (x + (to_x - x) * i / parts, y + (to_y - y) * i / parts))
        };
        let levels = self.levels().map(|(error, _)| plane.at(1.0, error).1);
        let levels = levels.map(|y| ((FRAME.left, y), (FRAME.right, y)));
        let curves = self.curves().map(|(from, to)| (at(from), at(to)));
        let lines = curves.chain(levels);
        let marks = self.0.entries.iter().map(at);
        lines.flat_map(between).chain(marks).collect()
    }

    /// Neighbours on the curve of one method: the next entry with which it has all but a parameter in common.
    fn curves(&self) -> impl Iterator<Item = (&MeasuredCrossing, &MeasuredCrossing)> {
        let entries = &self.0.entries;
        entries.iter().enumerate().filter_map(|(index, entry)| {
            let mut later = entries[index + 1..].iter();
            let next = later.find(|other| curve(entry) == curve(other))?;
            Some((entry, next))
        })
    }

    /// Thin lines through the results of one method with different parameters.
    fn draw_curves<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        at: impl Fn(&MeasuredCrossing) -> (i32, i32),
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        for (entry, next) in self.curves() {
            let line = colour(entry.info.kind).mix(0.45).stroke_width(2);
            area.draw(&PathElement::new(vec![at(entry), at(next)], line))?;
        }
        Ok(())
    }

    fn draw_labels<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        at: impl Fn(&MeasuredCrossing) -> (i32, i32),
        labels: &mut Labels,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        for entry in &self.0.entries {
            let Some(label) = figure_label(entry) else {
                continue;
            };
            let size = if entry.info.used { 26 } else { 22 };
            let (width, height) = area.estimate_text_size(&label, &text(size))?;
            let Some(frame) = labels.place(at(entry), (width as i32 + 8, height as i32 + 6)) else {
                continue;
            };
            let colour = colour(entry.info.kind);
            let leader = vec![at(entry), frame.nearest_to(at(entry))];
            area.draw(&PathElement::new(leader, colour.mix(0.6).stroke_width(1)))?;
            let corners = [(frame.left, frame.top), (frame.right, frame.bottom)];
            area.draw(&Rectangle::new(corners, WHITE.mix(0.8).filled()))?;
            let place = (frame.left + 4, frame.top + 3);
            let style = text(size).color(&colour);
            area.draw(&Text::new(label, place, style))?;
        }
        Ok(())
    }
}

/// What the entries of one curve have in common.
fn curve(entry: &MeasuredCrossing) -> (&'static str, usize, Option<&str>) {
    // Tables differ in how they are read, too.
    let reading = entry.info.knobs.split(' ').nth(3);
    (entry.info.name, entry.bits, reading)
}

/// The label of an entry: its name and parameters, if readers will look for it. The mark shows the arithmetic.
fn figure_label(entry: &MeasuredCrossing) -> Option<String> {
    let CrossingInfo {
        kind, name, knobs, ..
    } = &entry.info;
    let ends: &[&str] = match (kind, entry.bits) {
        (Kind::Weierstrass, 32) => &["0", "1"],
        (Kind::Weierstrass, _) => &["0", "1", "3"],
        (Kind::Jacobi, _) => &[""],
        (Kind::Table, _) => &["64 × 32", "512 × 256"],
        (Kind::Integrated, 32) => &["4 ", "16 ", "32 ", "128 "],
        (Kind::Integrated, _) => &["32 "],
    };
    let is_end = ends.iter().any(|end| knobs.starts_with(end));
    let separator = if knobs.is_empty() { "" } else { ", " };
    is_end.then(|| format!("{name}{separator}{knobs}"))
}

fn draw_title<DB: DrawingBackend>(area: &Area<DB>, methods: usize) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let title = format!("Where a ray crosses a disc: {methods} ways to find the radius");
    area.draw(&Text::new(title, (FRAME.left, 24), text(38)))?;
    let rays = "Crossings from r = 3 to 12, seen from r = 4, 10, 25 and 100, half of them near the shadow's edge. Lower is \
                more exact, left is faster.";
    let style = text(23).color(&Ink::GREY);
    area.draw(&Text::new(rays, (FRAME.left, 74), style))?;
    Ok(())
}

/// A dashed line at an error, with its name above its left end, whose box it returns.
fn draw_level<DB: DrawingBackend>(
    area: &Area<DB>,
    plane: &Plane,
    error: f64,
    name: &str,
) -> Result<PixelBox, Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let (_, y) = plane.at(1.0, error);
    for x in (FRAME.left..FRAME.right).step_by(16) {
        let dash = vec![(x, y), ((x + 9).min(FRAME.right), y)];
        area.draw(&PathElement::new(dash, Ink::GREY.stroke_width(2)))?;
    }
    let style = text(22).color(&Ink::GREY);
    let (width, height) = area.estimate_text_size(name, &style)?;
    let style = style.pos(Pos::new(HPos::Left, VPos::Bottom));
    area.draw(&Text::new(name.to_owned(), (FRAME.left + 10, y - 4), style))?;
    Ok(PixelBox {
        left: FRAME.left,
        top: y - height as i32 - 8,
        right: FRAME.left + width as i32 + 16,
        bottom: y + 2,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crossing_chart::{Workload, csv, measure, steps};
    use crate::figure::drawing::{png, svg};
    use crate::timing::Rounds;
    use std::cell::Cell;
    use std::sync::Mutex;
    use std::time::Duration;

    #[test]
    fn the_figure_names_the_methods_and_the_table_has_a_line_for_each() {
        let workload = Workload {
            crossings: 40,
            timed: 2,
            rounds: Rounds {
                count: 1,
                least: Duration::ZERO,
            },
            seed: 1,
        };
        let counted = Mutex::new(Cell::new(0));
        let count = || {
            let cell = counted.lock().unwrap();
            cell.set(cell.get() + 1);
        };
        let chart = measure(&workload, count).unwrap();
        assert_eq!(counted.lock().unwrap().get(), steps(&workload));
        let drawn = svg(&CrossingFigure(&chart)).unwrap();
        for name in ["1 duplication", "Jacobi", "64 × 32 bilinear", "RK4"] {
            assert!(drawn.contains(name), "{name}");
        }
        assert!(
            png(&CrossingFigure(&chart))
                .unwrap()
                .starts_with(b"\x89PNG")
        );
        let table = csv::text(&chart);
        assert_eq!(table.lines().count(), 2 + 5 * chart.entries.len());
        let columns: Vec<usize> = table.lines().map(|line| line.split(',').count()).collect();
        assert!(columns[0] == 14 && columns.iter().all(|&count| count >= 14));
    }
}
