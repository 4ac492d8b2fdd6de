//! The curves as CSV.

use super::{Curve, Curves};

/// The header line.
const HEAD: &str = "constant,image,level,line,x_m,y_m\n";

/// Least distance of the points of a line, M.
const SPACING: f64 = 0.25;

/// The points of all curves, one a line. `line` numbers the curves; lengths are in units of M.
pub fn text(curves: &Curves) -> String {
    let mut text = HEAD.to_owned();
    for (number, curve) in curves.curves.iter().enumerate() {
        text += &lines(number, curve);
    }
    text
}

fn lines(number: usize, curve: &Curve) -> String {
    let (kind, image, level) = (curve.kind.name(), curve.image.name(), curve.level);
    let line = |[x, y]: [f64; 2]| format!("{kind},{image},{level},{number},{x:.3},{y:.3}\n");
    thinned(&curve.points).into_iter().map(line).collect()
}

/// The ends of a line, and of its other points those that are at least [`SPACING`] apart.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for (index, &[x, y]) in points.iter().enumerate() {
        let is_last = index + 1 == points.len();
        let is_far = |last: &[f64; 2]| (x - last[0]).hypot(y - last[1]) >= SPACING;
        if is_last || kept.last().is_none_or(is_far) {
            kept.push([x, y]);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_of_a_line_are_kept() {
        let line: Vec<[f64; 2]> = (0..=70).map(|i| [0.1 * f64::from(i), 0.0]).collect();
        let kept = thinned(&line);
        assert_eq!((kept[0], kept[kept.len() - 1]), (line[0], line[70]));
        assert!(kept.len() > 20 && kept.len() < 30, "{}", kept.len());
    }
}
