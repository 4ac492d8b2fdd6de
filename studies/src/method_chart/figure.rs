//! The figure: error against time, log–log, with the Pareto front.

use super::marks::{Kind, Mark, draw_curves, draw_mark, place_labels};
use super::rays::ChartObserver;
use super::{MeasuredMethod, Section};
use crate::figure::drawing::{Area, Figure, Ink, text};
use crate::figure::{Labels, LogAxis, PixelBox, Plane, Ticks};
use crate::methods::Family;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// What errors are stated in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Radians on the sky.
    Radians,
    /// Pixels in image space.
    Pixels,
}

impl Unit {
    /// The largest error of an entry; of the model, which loses rays, the median (rad) or the RMS (px).
    fn error(self, entry: &MeasuredMethod) -> f64 {
        match (self, entry.info.family) {
            (Unit::Radians, Family::Model) => entry.median_on_sky,
            (Unit::Pixels, Family::Model) => entry.pixels.rms,
            (Unit::Radians, _) => entry.radians.max,
            (Unit::Pixels, _) => entry.pixels.max,
        }
    }

    /// The axis. Errors beyond it are drawn at its ends.
    fn axis(self) -> LogAxis {
        let range = match self {
            Unit::Radians => 1e-14..=1e3,
            Unit::Pixels => 1e-11..=1e5,
        };
        LogAxis::new(range, Ticks::Decades(2))
    }

    fn axis_name(self) -> &'static str {
        match self {
            Unit::Radians => "largest error on the sky, rad",
            Unit::Pixels => "largest error in image space, pixels",
        }
    }
}

/// The chart in one unit.
#[derive(Debug, Clone, Copy)]
pub struct ChartFigure<'a> {
    /// What was measured, the far observer first.
    pub sections: &'a [Section],
    /// The unit of the errors.
    pub unit: Unit,
}

const SIZE: (u32, u32) = (1600, 1150);
const FRAME: PixelBox = PixelBox {
    left: 150,
    top: 120,
    right: 1540,
    bottom: 1050,
};
/// The line of the Pareto front.
fn front_style() -> ShapeStyle {
    Ink::DARK.mix(0.55).stroke_width(3)
}

impl ChartFigure<'_> {
    fn far(&self) -> &[MeasuredMethod] {
        self.sections.first().map_or(&[], |far| &far.entries)
    }

    /// All that is drawn: the far observer's methods, and the model where it was used.
    fn marks(&self, plane: &Plane) -> Vec<Mark<'_>> {
        let far = self.far().iter().map(|entry| (entry, None));
        let models = self.sections.iter().skip(1).flat_map(|section| {
            let model = |entry: &&MeasuredMethod| entry.info.family == Family::Model;
            section
                .entries
                .iter()
                .filter(model)
                .map(move |entry| (entry, Some(section.observer)))
        });
        far.chain(models)
            .map(|(entry, observer)| Mark {
                entry,
                kind: Kind::of(entry),
                at: plane.at(entry.ns, self.unit.error(entry)),
                label: self.label(entry, observer),
            })
            .collect()
    }

    fn label(&self, entry: &MeasuredMethod, observer: Option<ChartObserver>) -> Option<String> {
        let error = self.unit.error(entry);
        let suffix = match observer {
            _ if error.is_infinite() => " (wrong outcome)",
            _ if error == 0.0 => " (is the truth here)",
            _ => "",
        };
        match observer {
            Some(ChartObserver::View(r)) => Some(format!("put at infinity, at r = {r}")),
            _ if Kind::of(entry) == Kind::Default => Some(format!(
                "{}: {:.0} ns, {} bytes",
                entry.info.name, entry.ns, entry.bytes
            )),
            _ if entry.info.landmark => Some(entry.info.label() + suffix),
            _ => None,
        }
    }
}

impl Figure for ChartFigure<'_> {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        self.draw_title(area)?;
        let plane = Plane {
            frame: FRAME,
            cost: LogAxis::new(1.0..=1e5, Ticks::Times),
            error: self.unit.axis(),
        };
        plane.draw(
            area,
            "time per ray on one CPU thread",
            self.unit.axis_name(),
        )?;
        let marks = self.marks(&plane);
        let point = |entry: &MeasuredMethod| (entry.ns, self.unit.error(entry));
        let points: Vec<_> = self.far().iter().map(point).collect();
        plane.draw_front(area, &points, front_style())?;
        self.draw_visible(area, &plane)?;
        draw_curves(area, &marks)?;
        let points = marks.iter().map(|mark| mark.at).collect();
        let mut labels = Labels::new(FRAME, points);
        self.draw_legend(area, &mut labels)?;
        let labels = place_labels(area, &mut labels, &marks)?;
        for label in &labels {
            label.draw_ground(area)?;
        }
        // The default row comes first and is drawn last, over all others.
        for mark in marks.iter().rev() {
            draw_mark(area, mark.kind, mark.at)?;
        }
        for label in &labels {
            label.draw_text(area)?;
        }
        Ok(())
    }
}

impl ChartFigure<'_> {
    fn draw_title<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let title = format!(
            "Light past a black hole: {} ways to find where it comes from",
            self.far().len()
        );
        area.draw(&Text::new(title, (FRAME.left, 24), text(38)))?;
        let rays = "Rays from infinity, b/b_c − 1 from 1e-6 to 100, as many in each decade. Lower is more \
                    exact, left is faster.";
        let style = text(25).color(&Ink::GREY);
        area.draw(&Text::new(rays, (FRAME.left, 72), style))?;
        Ok(())
    }

    /// The line above which an error may be seen.
    fn draw_visible<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        plane: &Plane,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        if self.unit == Unit::Pixels {
            let (_, y) = plane.at(1.0, 0.1);
            let line = vec![(FRAME.left, y), (FRAME.right, y)];
            area.draw(&PathElement::new(line, Ink::GREY.stroke_width(2)))?;
            let above = text(24)
                .color(&Ink::GREY)
                .pos(Pos::new(HPos::Left, VPos::Bottom));
            let what = "0.1 pixel: less is not seen";
            area.draw(&Text::new(what, (FRAME.left + 10, y - 4), above))?;
        }
        Ok(())
    }

    /// The legend, in the lower left corner of the plane.
    fn draw_legend<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        labels: &mut Labels,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        const LINE: i32 = 34;
        let rows = Kind::ALL.len() as i32 + 1;
        let frame = PixelBox {
            left: FRAME.left + 16,
            top: FRAME.bottom - 24 - rows * LINE,
            right: FRAME.left + 470,
            bottom: FRAME.bottom - 16,
        };
        labels.keep_free(frame);
        let corners = [(frame.left, frame.top), (frame.right, frame.bottom)];
        area.draw(&Rectangle::new(corners, WHITE.filled()))?;
        area.draw(&Rectangle::new(corners, Ink::PALE.stroke_width(2)))?;
        let style = text(24).pos(Pos::new(HPos::Left, VPos::Center));
        for (row, kind) in (0..).zip(Kind::ALL) {
            let y = frame.top + 24 + row * LINE;
            draw_mark(area, kind, (frame.left + 30, y))?;
            area.draw(&Text::new(
                self.kind_name(kind),
                (frame.left + 60, y),
                style.clone(),
            ))?;
        }
        let y = frame.top + 24 + (rows - 1) * LINE;
        let dash = vec![(frame.left + 12, y), (frame.left + 48, y)];
        area.draw(&PathElement::new(dash, front_style()))?;
        let front = "Pareto front: beaten by none in both";
        area.draw(&Text::new(front, (frame.left + 60, y), style))?;
        Ok(())
    }

    fn kind_name(&self, kind: Kind) -> &'static str {
        match (kind, self.unit) {
            (Kind::Default, _) => "the default row of this project",
            (Kind::Residual, _) => "tables of a residual",
            (Kind::Naive, _) => "tables of the bending itself",
            (Kind::Closed, _) => "closed forms and series",
            (Kind::Direct, _) => "integrators",
            (Kind::Model, Unit::Radians) => "exact, for the wrong observer (median)",
            (Kind::Model, Unit::Pixels) => "exact, for the wrong observer (RMS)",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::drawing::{png, svg};
    use crate::method_chart::{Workload, measure};

    #[test]
    fn the_figure_names_the_methods_that_readers_look_for() {
        let workload = Workload {
            rays: 20,
            timed_rays: 2,
            rounds: 1,
            batch_us: 0,
            seed: 1,
        };
        let sections = measure(&workload, || ()).unwrap();
        for unit in [Unit::Radians, Unit::Pixels] {
            let figure = ChartFigure {
                sections: &sections,
                unit,
            };
            let text = svg(&figure).unwrap();
            for name in [
                "lensbake default row",
                "RK4 f64",
                "elliptic integral",
                "r = 10",
            ] {
                assert!(text.contains(name), "{unit:?}: {name}");
            }
            assert!(png(&figure).unwrap().starts_with(b"\x89PNG"));
        }
    }
}
