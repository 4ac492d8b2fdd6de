//! The log–log plane of the chart: its map to pixels, its axes and its grid.

use super::labels::Frame;
use lensbake_report::drawing::{Area, Ink, text};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// A decade axis from 10ᵃ to 10ᵇ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decades {
    /// Exponent of the axis' foot.
    pub from: i32,
    /// Exponent of its head.
    pub to: i32,
}

impl Decades {
    /// Where `value` lies, from 0 to 1 along the axis; clamped to it.
    pub fn position(&self, value: f64) -> f64 {
        let span = f64::from(self.to - self.from);
        ((value.log10() - f64::from(self.from)) / span).clamp(0.0, 1.0)
    }
}

/// The plane: time along x, error along y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// The plane in pixels.
    pub frame: Frame,
    /// Time, ns.
    pub time: Decades,
    /// Error.
    pub error: Decades,
}

impl Plane {
    /// The pixel of a time and an error.
    pub fn at(&self, time: f64, error: f64) -> (i32, i32) {
        let Frame {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let x = f64::from(right - left) * self.time.position(time);
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
        time_name: &str,
        error_name: &str,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let Frame {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let line = |from, to| PathElement::new(vec![from, to], Ink::PALE.stroke_width(1));
        let below = Pos::new(HPos::Center, VPos::Top);
        let beside = Pos::new(HPos::Right, VPos::Center);
        for exponent in self.time.from..=self.time.to {
            let (x, _) = self.at(10f64.powi(exponent), 1.0);
            area.draw(&line((x, top), (x, bottom)))?;
            let ticks = text(24).pos(below);
            area.draw(&Text::new(time_tick(exponent), (x, bottom + 12), ticks))?;
        }
        for exponent in (self.error.from..=self.error.to).filter(|e| e % 2 == 0) {
            let (_, y) = self.at(1.0, 10f64.powi(exponent));
            area.draw(&line((left, y), (right, y)))?;
            let ticks = text(24).pos(beside);
            area.draw(&Text::new(format!("1e{exponent}"), (left - 12, y), ticks))?;
        }
        let border = Rectangle::new([(left, top), (right, bottom)], Ink::DARK.stroke_width(1));
        area.draw(&border)?;
        let middle = ((left + right) / 2, bottom + 50);
        area.draw(&Text::new(
            time_name.to_owned(),
            middle,
            text(28).pos(below),
        ))?;
        let upright = text(28)
            .transform(FontTransform::Rotate270)
            .pos(Pos::new(HPos::Center, VPos::Top));
        let middle = (left - 120, (top + bottom) / 2);
        area.draw(&Text::new(error_name.to_owned(), middle, upright))?;
        Ok(())
    }
}

fn time_tick(exponent: i32) -> String {
    match exponent {
        0..=2 => format!("{} ns", 10_i32.pow(exponent as u32)),
        3..=5 => format!("{} µs", 10_i32.pow(exponent as u32 - 3)),
        _ => format!("1e{exponent} ns"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_even_and_clamped() {
        let axis = Decades { from: -2, to: 2 };
        assert_eq!(axis.position(1e-2), 0.0);
        assert_eq!(axis.position(1.0), 0.5);
        assert_eq!(axis.position(f64::INFINITY), 1.0);
        assert_eq!(axis.position(0.0), 0.0);
    }
}
