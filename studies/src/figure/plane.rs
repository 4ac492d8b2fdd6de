//! A plane with two logarithmic axes: a cost in ns along x, an error along y.

use super::drawing::{Area, Ink, text};
use super::{PixelBox, front};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;
use std::ops::RangeInclusive;

/// A logarithmic axis.
#[derive(Debug, Clone, PartialEq)]
pub struct LogAxis {
    range: RangeInclusive<f64>,
    ticks: Ticks,
}

/// Which values of an axis have a tick and a grid line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ticks {
    /// Every power of ten, as a time.
    Times,
    /// The powers of ten whose exponents are multiples of this.
    Decades(i32),
    /// 1, 2 and 5 times each power of ten.
    OneTwoFive,
}

impl LogAxis {
    /// An axis over `range`, both ends above 0.
    pub fn new(range: RangeInclusive<f64>, ticks: Ticks) -> Self {
        LogAxis { range, ticks }
    }

    /// Where `value` lies along the axis, from 0 to 1; beyond the axis at its end.
    pub fn position(&self, value: f64) -> f64 {
        let (from, to) = (self.range.start().ln(), self.range.end().ln());
        ((value.ln() - from) / (to - from)).clamp(0.0, 1.0)
    }

    /// The values that have a tick, and its text.
    pub(crate) fn ticks(&self) -> Vec<(f64, String)> {
        let first = (self.range.start().log10() - 1e-9).floor() as i32;
        let last = (self.range.end().log10() + 1e-9).floor() as i32;
        let digits: &[u8] = match self.ticks {
            Ticks::OneTwoFive => &[1, 2, 5],
            Ticks::Times | Ticks::Decades(_) => &[1],
        };
        let step = match self.ticks {
            Ticks::Decades(step) => step,
            Ticks::Times | Ticks::OneTwoFive => 1,
        };
        let exponents = (first..=last).filter(|exponent| exponent % step == 0);
        let values = exponents.flat_map(|e| digits.iter().map(move |digit| (*digit, e)));
        let ticks = values.filter_map(|(digit, exponent)| {
            // Parsed, not a product: 5e-1 is to print as 0.5.
            let value: f64 = format!("{digit}e{exponent}").parse().ok()?;
            let name = match self.ticks {
                Ticks::Times => time_tick(exponent),
                Ticks::Decades(_) => format!("1e{exponent}"),
                Ticks::OneTwoFive => value.to_string(),
            };
            Some((value, name))
        });
        let (least, most) = (
            self.range.start() * (1.0 - 1e-9),
            self.range.end() * (1.0 + 1e-9),
        );
        ticks
            .filter(|(value, _)| (least..=most).contains(value))
            .collect()
    }
}

fn time_tick(exponent: i32) -> String {
    match exponent {
        0..=2 => format!("{} ns", 10_i32.pow(exponent as u32)),
        3..=5 => format!("{} µs", 10_i32.pow(exponent as u32 - 3)),
        _ => format!("1e{exponent} ns"),
    }
}

/// The plane and where it lies in the figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// The plane in pixels.
    pub frame: PixelBox,
    /// Cost, ns.
    pub cost: LogAxis,
    /// Error.
    pub error: LogAxis,
}

impl Plane {
    /// The pixel of a cost and an error; beyond the plane at its rim.
    pub fn at(&self, cost: f64, error: f64) -> (i32, i32) {
        let PixelBox {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let x = f64::from(right - left) * self.cost.position(cost);
        let y = f64::from(bottom - top) * self.error.position(error);
        (left + x as i32, bottom - y as i32)
    }

    /// Draws grid, frame, ticks and the names of the axes.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn draw<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        cost_name: &str,
        error_name: &str,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let PixelBox {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let line = |from, to| PathElement::new(vec![from, to], Ink::PALE.stroke_width(2));
        let below = text(26).pos(Pos::new(HPos::Center, VPos::Top));
        let beside = text(26).pos(Pos::new(HPos::Right, VPos::Center));
        for (cost, tick) in self.cost.ticks() {
            let x = self.at(cost, 1.0).0;
            area.draw(&line((x, top), (x, bottom)))?;
            area.draw(&Text::new(tick, (x, bottom + 14), below.clone()))?;
        }
        for (error, tick) in self.error.ticks() {
            let y = self.at(1.0, error).1;
            area.draw(&line((left, y), (right, y)))?;
            area.draw(&Text::new(tick, (left - 14, y + 4), beside.clone()))?;
        }
        let frame = [(left, top), (right, bottom)];
        area.draw(&Rectangle::new(frame, Ink::DARK.stroke_width(2)))?;
        let name = text(28).pos(Pos::new(HPos::Center, VPos::Top));
        let middle = ((left + right) / 2, bottom + 54);
        area.draw(&Text::new(cost_name.to_owned(), middle, name.clone()))?;
        let upright = name.transform(FontTransform::Rotate270);
        let middle = (left - 125, (top + bottom) / 2);
        area.draw(&Text::new(error_name.to_owned(), middle, upright))?;
        Ok(())
    }

    /// Draws the Pareto front of the points (cost, error) as a staircase, out to the right-hand side.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn draw_front<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        points: &[(f64, f64)],
        style: ShapeStyle,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let mut stairs: Vec<(i32, i32)> = Vec::new();
        for index in front(points) {
            let (x, y) = self.at(points[index].0, points[index].1);
            let above = stairs.last().map_or(self.frame.top, |last| last.1);
            stairs.extend([(x, above), (x, y)]);
        }
        if let Some(&(_, lowest)) = stairs.last() {
            stairs.push((self.frame.right, lowest));
            area.draw(&PathElement::new(stairs, style))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_logarithmic_and_clamped() {
        let axis = LogAxis::new(1e-2..=1e2, Ticks::Decades(1));
        assert_eq!(axis.position(1e-2), 0.0);
        assert!((axis.position(1.0) - 0.5).abs() < 1e-15);
        assert_eq!(axis.position(f64::INFINITY), 1.0);
        assert_eq!(axis.position(0.0), 0.0);
    }

    #[test]
    fn ticks_are_round_numbers() {
        let names = |range, ticks| {
            let ticks = LogAxis::new(range, ticks).ticks().into_iter();
            ticks.map(|(_, name)| name).collect::<Vec<_>>()
        };
        let ones = names(0.4..=60.0, Ticks::OneTwoFive);
        assert_eq!(ones, ["0.5", "1", "2", "5", "10", "20", "50"]);
        let decades = names(1e-3..=1e2, Ticks::Decades(1));
        assert_eq!(decades, ["1e-3", "1e-2", "1e-1", "1e0", "1e1", "1e2"]);
        assert_eq!(names(1e-3..=1e2, Ticks::Decades(2)), ["1e-2", "1e0", "1e2"]);
        assert_eq!(names(1e2..=1e4, Ticks::Times), ["100 ns", "1 µs", "10 µs"]);
    }
}
