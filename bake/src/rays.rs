//! The rays that tables are checked with.

use fastrand::Rng;
use lensbake_core::{EdgeCoordinate, Observer};
use lensbake_tables::{Axis, Header, Rows};

/// An observer and where he looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// The observer.
    pub observer: Observer,
    /// The edge coordinate of his view direction.
    pub at: EdgeCoordinate,
}

/// The smallest radius that random rays start from.
pub const R_MIN: f64 = 1.005;
/// The smallest 1 − x that random rays have.
pub const EDGE_GAP: f64 = 1e-6;

/// `count` random rays for `table`, the same for the same seed. Radii are uniform in χ from infinity to
/// [`R_MIN`] (or the table's own); half of the directions are uniform in the view angle from the
/// shadow's edge to straight away, half crowd the edge, 1 − x down to [`EDGE_GAP`] by decades. For an
/// axis in b they are uniform along the axis and by decades of its excess over b_c.
pub fn random(table: &Header, count: usize, seed: u64) -> Vec<Sight> {
    let mut rng = Rng::with_seed(seed);
    (0..count).map(|_| random_sight(table, &mut rng)).collect()
}

fn random_sight(table: &Header, rng: &mut Rng) -> Sight {
    let observer = match table.rows {
        Rows::One { .. } => table.observer(0),
        Rows::Chi { .. } => {
            let chi_max = (1.0 / R_MIN).sqrt().asin();
            Observer::at_chi(rng.f64() * chi_max)
        }
    };
    let crowd = rng.bool();
    let t = rng.f64();
    let at = match table.axis {
        Axis::Residual if crowd => edge_gap(EDGE_GAP.powf(t)),
        Axis::Residual if observer.is_far() => edge_gap(EDGE_GAP + t * (1.0 - EDGE_GAP)),
        Axis::Residual => away_from_edge(&observer, t),
        axis => in_b(axis, t, crowd),
    };
    Sight { observer, at }
}

fn edge_gap(one_minus_x: f64) -> EdgeCoordinate {
    EdgeCoordinate {
        x: 1.0 - one_minus_x,
        one_minus_x,
    }
}

/// Uniform in θ between the edge (less [`EDGE_GAP`]) and straight away.
fn away_from_edge(observer: &Observer, t: f64) -> EdgeCoordinate {
    let edge = observer.edge_angle();
    let at = observer.edge_coordinate(edge + t * (std::f64::consts::PI - edge));
    if at.one_minus_x < EDGE_GAP {
        edge_gap(EDGE_GAP)
    } else {
        at
    }
}

fn in_b(axis: Axis, t: f64, crowd: bool) -> EdgeCoordinate {
    match axis.b_range() {
        Some((b_min, b_max)) if crowd => Axis::UniformLogB { b_min, b_max }.coordinate(t),
        _ => axis.coordinate(t),
    }
}

/// Rays off the nodes of a table, dense enough to see its largest error: between all rows, down to the
/// last gap before the horizon; four a texel; and at the edge by decades of 1 − x down to [`EDGE_GAP`].
pub fn off_nodes(table: &Header) -> Vec<Sight> {
    let cells = 4 * (table.texels - 1);
    let within_cells = (0..cells).map(|i| (f64::from(i) + 0.5) / f64::from(cells));
    let mut along: Vec<EdgeCoordinate> = within_cells
        .map(|q| table.axis.coordinate(q))
        .filter(|at| at.one_minus_x >= EDGE_GAP)
        .collect();
    if table.axis == Axis::Residual {
        along.extend([1e-2, 1e-3, 1e-4, 1e-5, EDGE_GAP].map(edge_gap));
    }
    observers_off_nodes(table)
        .into_iter()
        .flat_map(|observer| along.iter().map(move |&at| Sight { observer, at }))
        .collect()
}

fn observers_off_nodes(table: &Header) -> Vec<Observer> {
    match table.rows {
        Rows::One { .. } => vec![table.observer(0)],
        Rows::Chi { count } => {
            let gaps = count - 1;
            (0..3 * gaps)
                .map(|i| (f64::from(i) + 0.5) / f64::from(3 * gaps))
                .map(|t| Observer::at_chi(t * std::f64::consts::FRAC_PI_2))
                .collect()
        }
    }
}
