//! Labels on the lines of a panel.

use super::{Curve, Image};
use crate::figure::PixelBox;

/// Half of a label's height, pixels.
const HALF_HEIGHT: i32 = 10;

/// A line in pixels, and the curve that it is.
pub struct Line<'a> {
    /// The curve.
    pub curve: &'a Curve,
    /// Its points, pixels.
    pub pixels: Vec<(i32, i32)>,
}

/// A label: the value of a curve, and its box, which is centred on the curve.
pub struct Label<'a> {
    /// The curve.
    pub curve: &'a Curve,
    /// The text.
    pub text: String,
    /// The box.
    pub frame: PixelBox,
}

/// Labels for the direct image in `lines` (the secondary one is too narrow), within `area` and outside the boxes of
/// `taken`. They do not overlap. Each value has one where it hides the fewest points of other lines, and more where they
/// hide none.
pub fn labels<'a>(lines: &[Line<'a>], area: &PixelBox, mut taken: Vec<PixelBox>) -> Vec<Label<'a>> {
    let mut placed: Vec<Label> = Vec::new();
    let direct = lines
        .iter()
        .filter(|line| line.curve.image == Image::Direct);
    let mut direct: Vec<&Line> = direct.collect();
    direct.sort_by_key(|line| std::cmp::Reverse(line.pixels.len()));
    for line in direct {
        let text = line.curve.level.to_string();
        let is_first = placed.iter().all(|label| label.text != text);
        let half_width = 5 * text.len() as i32 + 2;
        let frames = line.pixels.iter().map(|&(x, y)| PixelBox {
            left: x - half_width,
            top: y - HALF_HEIGHT,
            right: x + half_width,
            bottom: y + HALF_HEIGHT,
        });
        let free = frames.filter(|frame| {
            frame.within(area) && taken.iter().all(|other| frame.overlap(other) == 0)
        });
        let hidden = |frame: &PixelBox| hidden_points(lines, line.curve.level, frame);
        let best = free.map(|frame| (hidden(&frame), frame));
        let best = best.min_by_key(|(hidden, frame)| (*hidden, from_middle(line, frame)));
        let Some((hidden, frame)) = best else {
            continue;
        };
        if is_first || hidden == 0 {
            taken.push(frame);
            let curve = line.curve;
            placed.push(Label { curve, text, frame });
        }
    }
    placed
}

/// How many points of lines of other values lie at most a mark's size from the box.
fn hidden_points(lines: &[Line], level: f64, frame: &PixelBox) -> usize {
    let others = lines.iter().filter(|line| line.curve.level != level);
    let points = others.flat_map(|line| &line.pixels);
    points.filter(|&&point| frame.holds(point)).count()
}

/// How far the box is from the middle of its line, in points of the line.
fn from_middle(line: &Line, frame: &PixelBox) -> usize {
    let middle = (
        (frame.left + frame.right) / 2,
        (frame.top + frame.bottom) / 2,
    );
    let index = line.pixels.iter().position(|&pixel| pixel == middle);
    index.map_or(usize::MAX, |index| index.abs_diff(line.pixels.len() / 2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::luminet::Kind;

    const AREA: PixelBox = PixelBox {
        left: 0,
        top: 0,
        right: 400,
        bottom: 300,
    };

    #[test]
    fn labels_neither_overlap_nor_hide_another_line_where_there_is_room() {
        let curve = |level| Curve {
            kind: Kind::Flux,
            image: Image::Direct,
            level,
            points: Vec::new(),
        };
        let (a, b) = (curve(0.1), curve(0.25));
        // Two lines that part from each other.
        let pixels = |slope: i32| (1..40).map(|i| (10 * i, 150 + slope * i)).collect();
        let lines = [
            Line {
                curve: &a,
                pixels: pixels(3),
            },
            Line {
                curve: &b,
                pixels: pixels(-3),
            },
        ];
        let found = labels(&lines, &AREA, Vec::new());
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].frame.overlap(&found[1].frame), 0);
        for label in &found {
            assert_eq!(hidden_points(&lines, label.curve.level, &label.frame), 0);
        }
        assert!(labels(&lines, &AREA, vec![AREA]).is_empty());
    }
}
