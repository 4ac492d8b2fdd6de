//! The log–log plane of the chart: its map to pixels, its axes and its grid.

use lensbake_report::drawing::{Area, Ink, text};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::RangeInclusive;

/// The sides of the plane, pixels.
pub const LEFT: i32 = 150;
pub const RIGHT: i32 = 1560;
pub const TOP: i32 = 150;
pub const BOTTOM: i32 = 870;

/// The plane: a cost in ns along x, an error in pixels along y.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    cost: RangeInclusive<f64>,
    error: RangeInclusive<f64>,
}

/// Room left on either side of the costs for labels, as a factor.
const ROOM: f64 = 2.0;
/// An error of 0 is drawn here: f32 has none that small.
const LEAST_ERROR: f64 = 1e-9;

impl Plane {
    /// The plane that holds all `points` (cost, error): whole decades of the error.
    pub fn around(points: &[(f64, f64)]) -> Self {
        let range = |of: fn(&(f64, f64)) -> f64| {
            let values = points.iter().map(of).filter(|v| v.is_finite() && *v > 0.0);
            values.fold((f64::MAX, f64::MIN_POSITIVE), |(least, most), v| {
                (least.min(v), most.max(v))
            })
        };
        let (cheapest, dearest) = range(|p| p.0);
        let (least, most) = range(|p| p.1.max(LEAST_ERROR));
        Plane {
            cost: cheapest / ROOM..=dearest * ROOM,
            error: 10f64.powf(least.log10().floor())..=10f64.powf(most.log10().ceil()),
        }
    }

    /// The pixel of a cost and an error; beyond the plane at its rim.
    pub fn at(&self, cost: f64, error: f64) -> (i32, i32) {
        let position = |range: &RangeInclusive<f64>, value: f64| {
            let (from, to) = (range.start().ln(), range.end().ln());
            ((value.ln() - from) / (to - from)).clamp(0.0, 1.0)
        };
        let x = f64::from(RIGHT - LEFT) * position(&self.cost, cost);
        let y = f64::from(BOTTOM - TOP) * position(&self.error, error);
        (LEFT + x as i32, BOTTOM - y as i32)
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
    ) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        let line = |from, to| PathElement::new(vec![from, to], Ink::PALE.stroke_width(2));
        let below = text(26).pos(Pos::new(HPos::Center, VPos::Top));
        let beside = text(26).pos(Pos::new(HPos::Right, VPos::Center));
        for cost in one_two_five(&self.cost) {
            let (x, _) = self.at(cost, *self.error.end());
            area.draw(&line((x, TOP), (x, BOTTOM)))?;
            let tick = cost.to_string();
            area.draw(&Text::new(tick, (x, BOTTOM + 14), below.clone()))?;
        }
        for exponent in decades(&self.error) {
            let (_, y) = self.at(*self.cost.end(), 10f64.powi(exponent));
            area.draw(&line((LEFT, y), (RIGHT, y)))?;
            let tick = format!("1e{exponent}");
            area.draw(&Text::new(tick, (LEFT - 14, y + 4), beside.clone()))?;
        }
        let frame = [(LEFT, TOP), (RIGHT, BOTTOM)];
        area.draw(&Rectangle::new(frame, Ink::DARK.stroke_width(2)))?;
        let name = text(28).pos(Pos::new(HPos::Center, VPos::Top));
        let middle = ((LEFT + RIGHT) / 2, BOTTOM + 56);
        area.draw(&Text::new(cost_name.to_owned(), middle, name.clone()))?;
        let upright = name.transform(FontTransform::Rotate270);
        let middle = (LEFT - 125, (TOP + BOTTOM) / 2);
        area.draw(&Text::new(error_name.to_owned(), middle, upright))?;
        Ok(())
    }
}

/// The powers of ten within a range.
fn decades(range: &RangeInclusive<f64>) -> impl Iterator<Item = i32> {
    let first = (range.start().log10() - 1e-9).ceil() as i32;
    let last = (range.end().log10() + 1e-9).floor() as i32;
    first..=last
}

/// 1, 2 and 5 times the powers of ten within a range.
fn one_two_five(range: &RangeInclusive<f64>) -> impl Iterator<Item = f64> {
    let decades = range.start().log10().floor() as i32..=range.end().log10().floor() as i32;
    decades
        .flat_map(|exponent| {
            // Not powi alone: 5e-1 shall print as 0.5.
            [1, 2, 5].map(|digit| format!("{digit}e{exponent}").parse().unwrap_or(f64::NAN))
        })
        .filter(|tick| range.contains(tick))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_points_lie_within_and_the_axes_are_logarithmic() {
        let plane = Plane::around(&[(4.0, 2e-4), (400.0, 300.0)]);
        let (left, low) = plane.at(4.0, 2e-4);
        let (right, high) = plane.at(400.0, 300.0);
        assert!(LEFT < left && right < RIGHT && low < BOTTOM && high > TOP);
        let (middle, _) = plane.at(40.0, 1.0);
        assert!((middle - (left + right) / 2).abs() <= 1);
        assert_eq!(plane.at(40.0, 0.0).1, BOTTOM);
        assert_eq!(plane.at(40.0, f64::INFINITY).1, TOP);
    }

    #[test]
    fn ticks_are_round_numbers() {
        let ticks: Vec<f64> = one_two_five(&(0.4..=60.0)).collect();
        assert_eq!(ticks, [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]);
        assert!(decades(&(1e-3..=1e2)).eq(-3..=2));
    }
}
