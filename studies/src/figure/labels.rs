//! Placement of a figure's labels: they should hide neither each other nor the points.

use super::PixelBox;

/// Distances of a label from its point to try, pixels.
const DISTANCES: [i32; 7] = [18, 30, 50, 75, 105, 140, 180];
/// Directions to try, to the right first.
const DIRECTIONS: [(f64, f64); 12] = [
    (1.0, 0.0),
    (0.87, -0.5),
    (0.87, 0.5),
    (0.5, -0.87),
    (0.5, 0.87),
    (-1.0, 0.0),
    (-0.87, -0.5),
    (-0.87, 0.5),
    (0.0, -1.0),
    (0.0, 1.0),
    (-0.5, -0.87),
    (-0.5, 0.87),
];

/// Places labels one after another.
#[derive(Debug, Clone)]
pub struct Labels {
    area: PixelBox,
    points: Vec<(i32, i32)>,
    placed: Vec<PixelBox>,
}

impl Labels {
    /// No labels yet; they will lie within `area`, and should not hide `points`.
    pub fn new(area: PixelBox, points: Vec<(i32, i32)>) -> Self {
        Labels {
            area,
            points,
            placed: Vec::new(),
        }
    }

    /// Keeps a box free of labels.
    pub fn keep_free(&mut self, frame: PixelBox) {
        self.placed.push(frame);
    }

    /// The box for a label of this size near `point`: of the boxes within the area, the one with the least
    /// weighted sum of overlap with other labels, points hidden and distance. `None` if no box lies within the
    /// area.
    pub fn place(&mut self, point: (i32, i32), size: (i32, i32)) -> Option<PixelBox> {
        let best = DISTANCES
            .iter()
            .flat_map(|&distance| {
                DIRECTIONS.map(|direction| beside(point, size, distance, direction))
            })
            .filter(|frame| frame.within(&self.area))
            .min_by_key(|frame| self.cost(frame, point))?;
        self.placed.push(best);
        Some(best)
    }

    fn cost(&self, frame: &PixelBox, point: (i32, i32)) -> i64 {
        let overlap: i64 = self.placed.iter().map(|other| frame.overlap(other)).sum();
        let hidden = self.points.iter().filter(|&&p| frame.holds(p)).count() as i64;
        let gap_x = (frame.left - point.0).max(point.0 - frame.right).max(0);
        let gap_y = (frame.top - point.1).max(point.1 - frame.bottom).max(0);
        let distance = f64::from(gap_x).hypot(f64::from(gap_y)) as i64;
        100 * overlap + 150 * hidden + distance
    }
}

/// The box of `size` whose nearest side is `distance` from `point` in `direction`.
fn beside(
    point: (i32, i32),
    (width, height): (i32, i32),
    distance: i32,
    (dx, dy): (f64, f64),
) -> PixelBox {
    let at = |p: i32, d: f64, size: i32| {
        let anchor = p + (f64::from(distance) * d) as i32;
        anchor
            + (f64::from(size) * (0.5 * d.clamp(-1.0, 1.0).signum() * d.abs().sqrt() - 0.5)) as i32
    };
    let (left, top) = (at(point.0, dx, width), at(point.1, dy, height));
    PixelBox {
        left,
        top,
        right: left + width,
        bottom: top + height,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: PixelBox = PixelBox {
        left: 0,
        top: 0,
        right: 400,
        bottom: 300,
    };

    #[test]
    fn labels_of_one_point_do_not_overlap() {
        let mut labels = Labels::new(AREA, vec![(200, 150)]);
        let frames: Vec<PixelBox> = (0..6)
            .filter_map(|_| labels.place((200, 150), (80, 20)))
            .collect();
        assert_eq!(frames.len(), 6);
        for (i, a) in frames.iter().enumerate() {
            assert!(a.within(&AREA));
            assert!(frames[..i].iter().all(|b| a.overlap(b) == 0), "{frames:?}");
            assert!(!a.holds((200, 150)));
        }
    }

    #[test]
    fn a_label_larger_than_the_figure_has_no_place() {
        let mut labels = Labels::new(AREA, Vec::new());
        assert_eq!(labels.place((200, 150), (500, 20)), None);
    }
}
