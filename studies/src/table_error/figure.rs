//! The figure of `bake diff`: a table's error against the normalised shadow coordinate.

use super::Diff;
use crate::figure::drawing;
use plotters::prelude::*;
use std::error::Error;

/// Range of 1 − x, and the lower end of the error axis, rad.
const GAP: std::ops::Range<f64> = 1e-6..1.0;
const FLOOR: f64 = 1e-11;
/// Number of bins of 1 − x; the largest error in each is drawn.
const BINS: usize = 120;

/// A line of the figure.
#[derive(Debug, Clone)]
pub struct Curve<'a> {
    /// What is compared, for the legend.
    pub name: String,
    /// The rays.
    pub diff: &'a Diff,
    /// Largest error allowed, rad.
    pub budget: f64,
}

const COLOURS: [RGBColor; 3] = [BLUE, RGBColor(26, 127, 55), RGBColor(191, 75, 138)];

/// An SVG figure: for each of up to three curves the largest |lookup − closed form| (rad) in each bin of 1 − x,
/// log–log; and the budgets.
///
/// # Errors
/// An error of the drawing library.
pub fn error_figure(curves: &[Curve], title: &str) -> Result<String, Box<dyn Error>> {
    drawing::register_font();
    let bins: Vec<_> = curves
        .iter()
        .map(|curve| largest_by_bin(curve.diff))
        .collect();
    let budgets = budgets(curves);
    let errors = bins.iter().flatten().map(|bin| bin.1);
    let ceiling = budgets
        .iter()
        .copied()
        .chain(errors)
        .fold(FLOOR, f64::max)
        .min(1e3)
        * 3.0;
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (800, 480)).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .caption(title, ("sans-serif", 18))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(72)
            .build_cartesian_2d(GAP.log_scale(), (FLOOR..ceiling).log_scale())?;
        chart
            .configure_mesh()
            .x_desc("1 − x: shadow's edge at the left, straight away at the right")
            .y_desc("largest error, rad")
            .x_label_formatter(&|v| format!("{v:.0e}"))
            .y_label_formatter(&|v| format!("{v:.0e}"))
            .light_line_style(WHITE)
            .label_style(("sans-serif", 14))
            .draw()?;
        for ((curve, bins), colour) in curves.iter().zip(bins).zip(COLOURS) {
            chart
                .draw_series(LineSeries::new(bins, colour.stroke_width(2)))?
                .label(curve.name.as_str())
                .legend(move |(x, y)| {
                    PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2))
                });
        }
        for budget in budgets {
            chart
                .draw_series(LineSeries::new(
                    [(GAP.start, budget), (GAP.end, budget)],
                    RED.stroke_width(1),
                ))?
                .label(format!("budget {budget:.1e} rad"))
                .legend(|(x, y)| PathElement::new([(x, y), (x + 16, y)], RED.stroke_width(1)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerLeft)
            .background_style(WHITE)
            .border_style(BLACK)
            .label_font(("sans-serif", 14))
            .draw()?;
        root.present()?;
    }
    Ok(svg)
}

/// The budgets of the curves, each once.
fn budgets(curves: &[Curve]) -> Vec<f64> {
    let mut budgets: Vec<f64> = curves.iter().map(|curve| curve.budget).collect();
    budgets.dedup();
    budgets
}

fn largest_by_bin(diff: &Diff) -> Vec<(f64, f64)> {
    let decades = (GAP.end / GAP.start).log10();
    let mut largest = vec![0.0_f64; BINS];
    for ray in &diff.rays {
        let position = (ray.ray.observed.at.one_minus_x / GAP.start).log10() / decades;
        let bin = ((position * BINS as f64) as usize).min(BINS - 1);
        largest[bin] = largest[bin].max((ray.lookup - ray.closed).abs());
    }
    let centre = |bin: usize| GAP.start * 10f64.powf(decades * (bin as f64 + 0.5) / BINS as f64);
    largest
        .into_iter()
        .enumerate()
        .filter(|&(_, error)| error > 0.0)
        .map(|(bin, error)| (centre(bin), error.max(FLOOR)))
        .collect()
}
