//! Lines of constant value on a grid, by marching squares.

use std::collections::BTreeMap;

/// Values on the nodes of a rectangular grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    columns: usize,
    values: Vec<f64>,
}

/// The edge of a cell: from a node to the one on its right (false) or below it (true).
type Edge = (usize, usize, bool);

impl Grid {
    /// The grid of `value(column, row)`.
    pub fn new(columns: usize, rows: usize, value: impl Fn(usize, usize) -> f64) -> Self {
        let nodes = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        Grid {
            columns,
            values: nodes.map(|(column, row)| value(column, row)).collect(),
        }
    }

    /// The lines on which the value is `level`, as polylines of (column, row), between nodes by linear interpolation. They
    /// end at the border of the grid or are closed.
    pub fn contours(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        let mut neighbours = self.neighbours(level);
        let mut lines = Vec::new();
        // Lines with two ends first; what then remains is closed.
        for ends in [1, 2] {
            let starts: Vec<Edge> = neighbours.keys().copied().collect();
            for start in starts {
                if neighbours
                    .get(&start)
                    .is_some_and(|found| found.len() == ends)
                {
                    let line = follow(&mut neighbours, start);
                    lines.push(
                        line.into_iter()
                            .map(|edge| self.crossing(edge, level))
                            .collect(),
                    );
                }
            }
        }
        lines
    }

    fn value(&self, column: usize, row: usize) -> f64 {
        self.values[row * self.columns + column]
    }

    /// Of each edge that the line crosses, the edges that it crosses before and after.
    fn neighbours(&self, level: f64) -> BTreeMap<Edge, Vec<Edge>> {
        let rows = self.values.len() / self.columns;
        let mut neighbours: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
        for row in 0..rows - 1 {
            for column in 0..self.columns - 1 {
                for (from, to) in self.segments(column, row, level) {
                    neighbours.entry(from).or_default().push(to);
                    neighbours.entry(to).or_default().push(from);
                }
            }
        }
        neighbours
    }

    /// The parts of the line in a cell, each from edge to edge.
    fn segments(&self, column: usize, row: usize, level: f64) -> Vec<(Edge, Edge)> {
        let nodes = [
            (column, row),
            (column + 1, row),
            (column + 1, row + 1),
            (column, row + 1),
        ];
        let above = nodes.map(|(column, row)| self.value(column, row) > level);
        // The edges around the cell, each from its node to the next.
        let edges = [
            (column, row, false),
            (column + 1, row, true),
            (column, row + 1, false),
            (column, row, true),
        ];
        let crossed: Vec<Edge> = (0..4)
            .filter(|&i| above[i] != above[(i + 1) % 4])
            .map(|i| edges[i])
            .collect();
        match crossed[..] {
            [from, to] => vec![(from, to)],
            [top, right, bottom, left] => {
                let sum: f64 = nodes.iter().map(|&(c, r)| self.value(c, r)).sum();
                // The line cuts off the two nodes that differ from the middle.
                match (0.25 * sum > level) == above[0] {
                    true => vec![(top, right), (bottom, left)],
                    false => vec![(left, top), (right, bottom)],
                }
            }
            _ => Vec::new(),
        }
    }

    /// Where the line crosses an edge.
    fn crossing(&self, (column, row, down): Edge, level: f64) -> [f64; 2] {
        let from = self.value(column, row);
        let to = match down {
            true => self.value(column, row + 1),
            false => self.value(column + 1, row),
        };
        let part = (level - from) / (to - from);
        let [x, y] = [column as f64, row as f64];
        match down {
            true => [x, y + part],
            false => [x + part, y],
        }
    }
}

/// Takes the line that begins at `start` out of `neighbours`; a closed line ends where it begins.
fn follow(neighbours: &mut BTreeMap<Edge, Vec<Edge>>, start: Edge) -> Vec<Edge> {
    let mut line = vec![start];
    let mut at = start;
    while let Some(next) = neighbours.get_mut(&at).and_then(Vec::pop) {
        if let Some(back) = neighbours.get_mut(&next) {
            back.retain(|edge| *edge != at);
        }
        line.push(next);
        at = next;
    }
    neighbours.retain(|_, left| !left.is_empty());
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contours_of_a_cone_are_circles() {
        let grid = Grid::new(41, 31, |column, row| {
            (column as f64 - 20.0).hypot(row as f64 - 15.0)
        });
        let lines = grid.contours(10.3);
        assert_eq!(lines.len(), 1);
        let line = &lines[0];
        assert_eq!(line.first(), line.last());
        for [x, y] in line {
            assert!(((x - 20.0).hypot(y - 15.0) - 10.3).abs() < 0.02);
        }
        // Cut by the border above and below.
        let cut = grid.contours(17.0);
        assert_eq!(cut.len(), 2);
        assert!(cut.iter().flatten().any(|point| point[1] == 0.0));
    }

    #[test]
    fn a_saddle_has_two_lines() {
        let grid = Grid::new(2, 2, |column, row| if column == row { 1.0 } else { 0.0 });
        for level in [0.4, 0.6] {
            let lines = grid.contours(level);
            assert_eq!(lines.len(), 2, "{lines:?}");
            assert!(lines.iter().all(|line| line.len() == 2));
        }
        assert!(grid.contours(2.0).is_empty());
    }
}
