//! The figure: the time per ray of a few contenders against the size of the picture.

use super::contender::{Contender, FILTERED, FINEST, FLAT, LUT};
use super::{Bench, MeasuredContender};
use crate::figure::drawing::{Area, Figure, Ink, text};
use crate::figure::{LogAxis, Ticks};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

const SIZE: (u32, u32) = (1600, 900);
/// Height of the title, pixels.
const TITLE: u32 = 90;
/// Height of the names of the sizes, pixels.
const BELOW: u32 = 110;
/// Width of the names of the times, pixels.
const BESIDE: u32 = 110;
/// Width of the names of the contenders, pixels.
const NAMES: u32 = 330;
/// Least distance between the names of two contenders, pixels.
const LINE: i32 = 36;
/// The contenders of the figure, and their colours.
const SHOWN: [(Contender, RGBColor); 6] = [
    (FINEST, RGBColor(101, 109, 118)),
    (FILTERED.with_stars(), RGBColor(188, 76, 0)),
    (FILTERED, RGBColor(207, 34, 46)),
    (LUT.with_stars(), RGBColor(84, 148, 222)),
    (LUT, RGBColor(9, 105, 218)),
    (FLAT, RGBColor(26, 127, 55)),
];

/// The plane of the figure: logarithms of the number of pixels and of the time.
type Chart<'a, DB> = ChartContext<'a, DB, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The time per ray against the number of pixels.
#[derive(Debug)]
pub struct CostOfSize<'a>(pub &'a Bench);

impl Figure for CostOfSize<'_> {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        let title = format!("Time per ray, {}", self.0.adapter);
        area.draw(&Text::new(title, (BESIDE as i32, 26), text(34)))?;
        let curves = SHOWN.map(|(contender, colour)| self.curve(contender, colour));
        let points = || curves.iter().flat_map(|curve| &curve.points);
        let (across, up) = (
            around(points().map(|point| point.0), 0.15),
            around(points().map(|point| point.1), 0.2),
        );
        let mut chart = ChartBuilder::on(area)
            .margin_top(TITLE)
            .margin_right(NAMES)
            .x_label_area_size(BELOW)
            .y_label_area_size(BESIDE)
            .build_cartesian_2d(across.0..across.1, up.0..up.1)?;
        self.draw_grid(area, &mut chart)?;
        for curve in &curves {
            let line = curve.colour.stroke_width(4);
            chart.draw_series(LineSeries::new(curve.points.iter().copied(), line))?;
            let dots = curve.points.iter();
            chart.draw_series(dots.map(|&at| Circle::new(at, 6, curve.colour.filled())))?;
        }
        draw_names(area, &chart, &curves)
    }
}

impl CostOfSize<'_> {
    fn curve(&self, contender: Contender, colour: RGBColor) -> Curve {
        let entries: Vec<&MeasuredContender> = self
            .0
            .sizes()
            .map(|size| self.0.entry(size, contender))
            .collect();
        let mut points: Vec<(f64, f64)> = entries.iter().map(|entry| point(entry)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Curve {
            name: entries.first().map_or(String::new(), |entry| entry.name()),
            colour,
            points,
        }
    }

    /// Draws a line for each size and for round times, and their names.
    fn draw_grid<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        chart: &mut Chart<DB>,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let grid = Ink::PALE.stroke_width(2);
        let (across, up) = (chart.x_range(), chart.y_range());
        for size in self.0.sizes() {
            let x = ln_pixels(size);
            chart.draw_series(LineSeries::new([(x, up.start), (x, up.end)], grid))?;
            let below = text(24).pos(Pos::new(HPos::Center, VPos::Top));
            let (x, y) = chart.backend_coord(&(x, up.start));
            let name = format!("{} × {}", size.0, size.1);
            area.draw(&Text::new(name, (x, y + 14), below))?;
        }
        let times = LogAxis::new(up.start.exp()..=up.end.exp(), Ticks::OneTwoFive);
        for (ns, name) in times.ticks() {
            let line = [(across.start, ns.ln()), (across.end, ns.ln())];
            chart.draw_series(LineSeries::new(line, grid))?;
            let beside = text(24).pos(Pos::new(HPos::Right, VPos::Center));
            let (x, y) = chart.backend_coord(&line[0]);
            area.draw(&Text::new(format!("{name} ns"), (x - 14, y + 4), beside))?;
        }
        Ok(())
    }
}

/// Draws the name of each curve beside its last point, below the name before it.
fn draw_names<DB: DrawingBackend>(
    area: &Area<DB>,
    chart: &Chart<DB>,
    curves: &[Curve],
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let mut ends: Vec<(i32, &Curve)> = curves
        .iter()
        .filter_map(|curve| Some((chart.backend_coord(curve.points.last()?).1, curve)))
        .collect();
    ends.sort_by_key(|(y, _)| *y);
    let mut free = i32::MIN;
    for (y, curve) in ends {
        let y = y.max(free);
        free = y + LINE;
        let style = text(26).pos(Pos::new(HPos::Left, VPos::Center));
        let at = ((SIZE.0 - NAMES) as i32 + 16, y);
        let name = curve.name.clone();
        area.draw(&Text::new(name, at, style.color(&curve.colour)))?;
    }
    Ok(())
}

/// One contender: (ln pixels, ln T_ray) at each size, in ascending order.
struct Curve {
    name: String,
    colour: RGBColor,
    points: Vec<(f64, f64)>,
}

/// The logarithm of the number of pixels of a picture.
fn ln_pixels((width, height): (u32, u32)) -> f64 {
    (f64::from(width) * f64::from(height)).ln()
}

fn point(entry: &MeasuredContender) -> (f64, f64) {
    let measured = entry.measured;
    let ns = measured.gpu_ns_per_ray.unwrap_or(measured.wall_ns_per_ray);
    (ln_pixels(entry.size), ns.max(1e-6).ln())
}

/// The range of these values, and `margin` more at either end.
fn around(values: impl Iterator<Item = f64> + Clone, margin: f64) -> (f64, f64) {
    let least = values.clone().fold(f64::INFINITY, f64::min);
    let most = values.fold(f64::NEG_INFINITY, f64::max);
    (least - margin, most + margin)
}

#[cfg(test)]
mod tests {
    use super::super::report::tests::bench;
    use super::*;
    use crate::figure::drawing::svg;

    #[test]
    fn it_names_every_curve_and_every_size() {
        let mut of_two_sizes = bench(None);
        let mut larger = bench(Some(5.0)).entries;
        for entry in &mut larger {
            entry.size = (400, 300);
        }
        of_two_sizes.entries.extend(larger);
        let figure = svg(&CostOfSize(&of_two_sizes)).unwrap();
        for text in [
            "4 × 3",
            "400 × 300",
            "5 ns",
            "direct 63 steps",
            "lut filtered with stars",
        ] {
            assert!(figure.contains(text), "{text}");
        }
    }
}
