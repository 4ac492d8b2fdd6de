//! The figure: light found over light expected in each frame, for a few stars.

use super::{FlickerFrame, Track};
use crate::figure::drawing::{Area, Figure, Ink, text};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;
use std::f64::consts::TAU;

const WIDTH: u32 = 1600;
/// Heights of the title with the legend, of the panel of a star, and of the name of the x axis, pixels.
const TITLE: u32 = 170;
const PANEL: u32 = 350;
const FOOT: u32 = 60;
/// Middle of the y axis in its panel, pixels from the top.
const MIDDLE: i32 = 172;
/// Left edge of the text of the title and of the panels, pixels.
const LEFT: i32 = 130;

const POINT: RGBColor = RGBColor(207, 34, 46);
const FILTERED: RGBColor = RGBColor(188, 76, 0);
const NEAREST: RGBColor = RGBColor(84, 148, 222);

/// A curve of the figure.
struct Curve {
    name: &'static str,
    colour: RGBColor,
    width: u32,
    /// Light found over light expected; `None` for a gap in the curve.
    at: fn(&FlickerFrame) -> Option<f64>,
}

/// The curves, from the lowest to the topmost layer.
const CURVES: [Curve; 3] = [
    Curve {
        name: "a texel, one ray per pixel",
        colour: NEAREST,
        width: 4,
        at: |frame| frame.texel.map(|texel| texel.nearest),
    },
    Curve {
        name: "a texel, filtered",
        colour: FILTERED,
        width: 4,
        at: |frame| frame.texel.map(|texel| texel.filtered),
    },
    Curve {
        name: "a point",
        colour: POINT,
        width: 5,
        at: |frame| frame.texel.map(|_| frame.point),
    },
];

/// The figure, one panel per star.
#[derive(Debug)]
pub struct Panels<'a>(pub &'a [&'a Track]);

impl Figure for Panels<'_> {
    fn size(&self) -> (u32, u32) {
        (WIDTH, TITLE + PANEL * self.0.len() as u32 + FOOT)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        draw_title(area)?;
        let (_, below) = area.split_vertically(TITLE);
        let reach = self.0.iter().map(|track| reach(track)).max().unwrap_or(1);
        let (panels, foot) = below.split_vertically(PANEL * self.0.len() as u32);
        for (track, panel) in self.0.iter().zip(panels.split_evenly((self.0.len(), 1))) {
            draw_panel(&panel, track, reach)?;
        }
        let middle = text(28).pos(Pos::new(HPos::Center, VPos::Center));
        let at = ((LEFT + WIDTH as i32) / 2, FOOT as i32 / 2);
        let name = "frame, from the one in which the star is nearest to the hole";
        foot.draw(&Text::new(name, at, middle))?;
        Ok(())
    }
}

fn draw_title<DB: DrawingBackend>(area: &Area<DB>) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let title = "A star's light in the picture over the analytic curve, frame by frame";
    area.draw(&Text::new(title, (LEFT, 26), text(36)))?;
    let mut x = LEFT;
    for curve in CURVES.iter().rev() {
        let (from, to) = ((x, 112), (x + 60, 112));
        area.draw(&PathElement::new(
            vec![from, to],
            curve.colour.stroke_width(curve.width + 2),
        ))?;
        let style = text(30).pos(Pos::new(HPos::Left, VPos::Center));
        let (width, _) = area.estimate_text_size(curve.name, &style)?;
        area.draw(&Text::new(curve.name, (x + 78, 116), style))?;
        x += 78 + width as i32 + 70;
    }
    Ok(())
}

fn draw_panel<DB: DrawingBackend>(
    area: &Area<DB>,
    track: &Track,
    reach: i32,
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    area.draw(&Text::new(caption(track), (LEFT, 6), text(28)))?;
    let frames = -f64::from(reach)..f64::from(reach);
    let mut chart = ChartBuilder::on(area)
        .margin_top(44)
        .margin_right(40)
        .x_label_area_size(48)
        .y_label_area_size(LEFT as u32)
        .build_cartesian_2d(frames, 0.0..top(track))?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(Ink::PALE.stroke_width(2))
        .axis_style(Ink::GREY.stroke_width(2))
        .label_style(text(26))
        .x_labels(13)
        .y_labels(4)
        .x_label_formatter(&|frame| format!("{frame:.0}").replace('-', "−"))
        .y_label_formatter(&|ratio| ratio.to_string())
        .draw()?;
    let upright = text(26)
        .pos(Pos::new(HPos::Center, VPos::Center))
        .transform(FontTransform::Rotate270);
    area.draw(&Text::new("found / expected", (36, MIDDLE), upright))?;
    for curve in &CURVES {
        draw_curve(&mut chart, track, curve)?;
    }
    Ok(())
}

/// The star's position, magnitude, brightening and errors.
fn caption(track: &Track) -> String {
    let star = &track.subject.star;
    let percent = |part: f64| {
        if part < 0.001 {
            format!("{:.4} %", 100.0 * part)
        } else {
            format!("{:.0} %", 100.0 * part)
        }
    };
    format!(
        "RA {:.1}°, Dec {:.1}°, magnitude {:.1}, at most {:.1} times brighter. RMS: point {}, filtered {}, one ray {}",
        star.right_ascension.to_degrees(),
        star.declination.to_degrees(),
        star.magnitude,
        track.peak(),
        percent(track.point().rms),
        percent(track.filtered().rms),
        percent(track.nearest().rms),
    )
    .replace('-', "−")
}

fn draw_curve<DB: DrawingBackend>(
    chart: &mut ChartContext<DB, Cartesian2d<RangedCoordf64, RangedCoordf64>>,
    track: &Track,
    curve: &Curve,
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let mut points: Vec<(i32, f64)> = track
        .frames
        .iter()
        .filter_map(|frame| Some((from_nearest(track, frame.number), (curve.at)(frame)?)))
        .collect();
    points.sort_by_key(|(frame, _)| *frame);
    // A frame that does not count leaves a gap.
    for run in points.chunk_by(|a, b| b.0 == a.0 + 1) {
        let line = run.iter().map(|&(frame, ratio)| (f64::from(frame), ratio));
        chart.draw_series(LineSeries::new(
            line,
            curve.colour.stroke_width(curve.width),
        ))?;
    }
    Ok(())
}

/// The number of frames from the one in which the star is nearest to the hole, counted the shorter way round the
/// orbit, negative before it. In that frame the hole is seen at the star's right ascension.
fn from_nearest(track: &Track, number: usize) -> i32 {
    let all = track.subject.curve.len() as i32;
    let turn = track.subject.star.right_ascension / TAU;
    let nearest = (turn * f64::from(all)).round() as i32;
    (number as i32 - nearest + all / 2).rem_euclid(all) - all / 2
}

/// Half the width of the x axis, frames: one more than the farthest frame that is drawn.
fn reach(track: &Track) -> i32 {
    let drawn = track.frames.iter().filter(|frame| frame.texel.is_some());
    drawn
        .map(|frame| from_nearest(track, frame.number).abs())
        .max()
        .unwrap_or(0)
        + 1
}

/// The top of the y axis: a multiple of 1/2 above all that is drawn.
fn top(track: &Track) -> f64 {
    let ratios = track
        .texel_frames()
        .map(|texel| texel.nearest.max(texel.filtered));
    (2.0 * ratios.fold(1.5, f64::max)).floor() / 2.0 + 0.5
}
