//! The curves as CSV.

use super::{Curve, Curves};

/// The header line.
const HEAD: &str = "constant,image,level,line,x_m,y_m\n";

/// All points of all curves, one a line. `line` numbers the curves; lengths are in units of M.
pub fn text(curves: &Curves) -> String {
    let mut text = HEAD.to_owned();
    for (number, curve) in curves.curves.iter().enumerate() {
        text += &lines(number, curve);
    }
    text
}

fn lines(number: usize, curve: &Curve) -> String {
    let (kind, image, level) = (curve.kind.name(), curve.image.name(), curve.level);
    let line = |[x, y]: &[f64; 2]| format!("{kind},{image},{level},{number},{x:.3},{y:.3}\n");
    curve.points.iter().map(line).collect()
}
