//! The heat map: one line per regime, one column per method.

use super::{Atlas, Line, Verdict, is_product};
use crate::figure::drawing::{Area, Figure, Ink, text};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// The figure of an atlas.
#[derive(Debug, Clone, Copy)]
pub struct HeatMap<'a> {
    /// The atlas.
    pub atlas: &'a Atlas,
    /// Whose regimes they are, for the title: "at rest", for example.
    pub observers: &'static str,
}

const LEFT: i32 = 430;
const TOP: i32 = 520;
const MARGIN: i32 = 24;
const CELL: (i32, i32) = (61, 30);
/// Space above each group of lines, pixels; half of it follows the product's columns.
const GAP: i32 = 34;

/// Positions in the map, pixels.
struct Layout {
    columns: Vec<i32>,
    lines: Vec<i32>,
    /// Top and name of each group.
    groups: Vec<(i32, &'static str)>,
    size: (i32, i32),
}

impl HeatMap<'_> {
    fn layout(&self) -> Layout {
        let mut x = LEFT;
        let mut columns = Vec::new();
        for (index, info) in self.atlas.columns.iter().enumerate() {
            let before = index
                .checked_sub(1)
                .map(|i| is_product(&self.atlas.columns[i]));
            if before == Some(true) && !is_product(info) {
                x += GAP / 2;
            }
            columns.push(x);
            x += CELL.0;
        }
        let mut y = TOP;
        let (mut lines, mut groups) = (Vec::new(), Vec::new());
        for Line { regime, .. } in &self.atlas.lines {
            if groups.last().map(|&(_, name)| name) != Some(regime.group) {
                y += GAP;
                groups.push((y, regime.group));
            }
            lines.push(y);
            y += CELL.1;
        }
        Layout {
            columns,
            lines,
            groups,
            size: (x + MARGIN, y + MARGIN),
        }
    }
}

impl Figure for HeatMap<'_> {
    fn size(&self) -> (u32, u32) {
        let (width, height) = self.layout().size;
        (width as u32, height as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        area.fill(&WHITE)?;
        let layout = self.layout();
        let title = format!("Where methods fail for observers {}", self.observers);
        area.draw(&Text::new(title, (MARGIN, 24), text(38)))?;
        let colours = "this project's own methods in red, the others beside them";
        area.draw(&Text::new(colours, (MARGIN, 70), text(22)))?;
        self.draw_heads(area, &layout)?;
        self.draw_names(area, &layout)?;
        for (line, &y) in self.atlas.lines.iter().zip(&layout.lines) {
            for (&verdict, &x) in line.verdicts.iter().zip(&layout.columns) {
                draw_cell(area, verdict, (x, y), short(verdict))?;
            }
        }
        draw_legend(area)
    }
}

impl HeatMap<'_> {
    fn draw_heads<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        layout: &Layout,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        for (info, &x) in self.atlas.columns.iter().zip(&layout.columns) {
            let ink = if is_product(info) {
                RGBColor(207, 34, 46)
            } else {
                Ink::DARK
            };
            let style = text(22)
                .color(&ink)
                .transform(FontTransform::Rotate270)
                .pos(Pos::new(HPos::Left, VPos::Center));
            let foot = (x + CELL.0 / 2, TOP + GAP - 10);
            area.draw(&Text::new(info.label(), foot, style))?;
        }
        Ok(())
    }

    fn draw_names<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        layout: &Layout,
    ) -> Result<(), Box<dyn Error>>
    where
        DB::ErrorType: 'static,
    {
        let group = text(23)
            .color(&Ink::GREY)
            .pos(Pos::new(HPos::Left, VPos::Bottom));
        for &(y, name) in &layout.groups {
            area.draw(&Text::new(name, (MARGIN, y - 3), group.clone()))?;
        }
        let right = text(22).pos(Pos::new(HPos::Right, VPos::Center));
        for (line, &y) in self.atlas.lines.iter().zip(&layout.lines) {
            let place = (LEFT - 12, y + CELL.1 / 2);
            area.draw(&Text::new(line.regime.name, place, right.clone()))?;
        }
        Ok(())
    }
}

fn draw_cell<DB: DrawingBackend>(
    area: &Area<DB>,
    verdict: Verdict,
    (x, y): (i32, i32),
    word: String,
) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let corners = [(x + 1, y + 1), (x + CELL.0 - 1, y + CELL.1 - 1)];
    let (ground, ink) = colours(verdict);
    area.draw(&Rectangle::new(corners, ground.filled()))?;
    let style = text(19)
        .color(&ink)
        .pos(Pos::new(HPos::Center, VPos::Center));
    area.draw(&Text::new(word, (x + CELL.0 / 2, y + CELL.1 / 2), style))?;
    Ok(())
}

/// Draws the legend, above the names of the regimes.
fn draw_legend<DB: DrawingBackend>(area: &Area<DB>) -> Result<(), Box<dyn Error>>
where
    DB::ErrorType: 'static,
{
    let kinds = [
        (Verdict::Right, "right to 1e-6 rad"),
        (Verdict::Refused, "no such ray: refused in words"),
        (Verdict::Off(1e-4), "off by this, rad"),
        (Verdict::WrongOutcome, "captured for escaping or reverse"),
        (Verdict::NotANumber, "not a number"),
        (Verdict::Unfinished, "gave up at its cap of steps"),
        (Verdict::RefusedRay, "refused though there is a ray"),
        (Verdict::Nonsense, "no such ray: answered all the same"),
        (Verdict::NotServed, "serves other observers only"),
    ];
    let style = text(22).pos(Pos::new(HPos::Left, VPos::Center));
    for (row, (verdict, meaning)) in (0..).zip(kinds) {
        let y = 110 + row * (CELL.1 + 6);
        draw_cell(area, verdict, (MARGIN, y), short(verdict))?;
        let place = (MARGIN + CELL.0 + 12, y + CELL.1 / 2);
        area.draw(&Text::new(meaning, place, style.clone()))?;
    }
    Ok(())
}

/// The short form of a verdict, which fits in a cell.
fn short(verdict: Verdict) -> String {
    match verdict {
        Verdict::Right => "ok".to_owned(),
        Verdict::Off(error) => format!("{error:.0e}"),
        Verdict::WrongOutcome => "wrong".to_owned(),
        Verdict::NotANumber => "NaN".to_owned(),
        Verdict::Unfinished => "cap".to_owned(),
        Verdict::Refused => "no".to_owned(),
        Verdict::RefusedRay => "no!".to_owned(),
        Verdict::Nonsense => "yes?".to_owned(),
        Verdict::NotServed => "·".to_owned(),
    }
}

/// Background and text colour; the larger an error, the redder.
fn colours(verdict: Verdict) -> (RGBColor, RGBColor) {
    let (green, blue) = (RGBColor(205, 236, 212), RGBColor(205, 228, 250));
    match verdict {
        Verdict::Right => (green, RGBColor(17, 99, 41)),
        Verdict::Refused => (blue, RGBColor(9, 80, 170)),
        Verdict::Off(error) if error < 1e-4 => (RGBColor(255, 243, 196), Ink::DARK),
        Verdict::Off(error) if error < 1e-2 => (RGBColor(255, 218, 140), Ink::DARK),
        Verdict::Off(error) if error < 1.0 => (RGBColor(250, 172, 110), Ink::DARK),
        Verdict::Off(_) => (RGBColor(240, 120, 90), Ink::DARK),
        Verdict::WrongOutcome => (RGBColor(164, 14, 38), WHITE),
        Verdict::NotANumber => (RGBColor(111, 66, 193), WHITE),
        Verdict::Unfinished => (RGBColor(66, 74, 83), WHITE),
        Verdict::RefusedRay => (RGBColor(33, 139, 255), WHITE),
        Verdict::Nonsense => (RGBColor(191, 75, 138), WHITE),
        Verdict::NotServed => (RGBColor(246, 248, 250), RGBColor(175, 184, 193)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::drawing::{png, svg};
    use crate::stability::{Input, Regime, Truth};

    #[test]
    fn the_map_shows_regimes_methods_and_verdicts() {
        let observer = lensbake_core::Observer::at_infinity();
        let methods = crate::stability::columns::for_observer(observer).unwrap();
        let columns: Vec<_> = methods.iter().map(|method| method.info()).collect();
        let regime = Regime {
            group: "a group",
            name: "a regime",
            input: Input::FromInfinity(3.0),
            truth: Truth::Captured,
        };
        let atlas = Atlas {
            lines: vec![Line {
                regime,
                verdicts: vec![Verdict::WrongOutcome; columns.len()],
            }],
            columns,
        };
        let map = HeatMap {
            atlas: &atlas,
            observers: "at rest",
        };
        let text = svg(&map).unwrap();
        for word in [
            "at rest",
            "a group",
            "a regime",
            "lensbake default row",
            "wrong",
        ] {
            assert!(text.contains(word), "{word}");
        }
        assert!(png(&map).unwrap().starts_with(b"\x89PNG"));
    }
}
