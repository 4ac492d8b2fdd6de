//! A number that follows a smooth curve through values at given times.
//!
//! The curve is a cubic Hermite spline with the slopes of Fritsch and Butland (the harmonic mean of the secants' slopes, 0
//! at a turning point). Between two nodes it stays between their values, and it has no kink.

/// Slope of the curve at its first or last node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EndSlope {
    /// 0: the value comes from a standstill or to one.
    Still,
    /// That of the secant to the next node.
    Secant,
}

/// The curve. Before its first node and after its last one it is constant.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curve {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    time: f64,
    value: f64,
    slope: f64,
}

impl Curve {
    /// The curve through `nodes`, (time, value) at growing times, at least one.
    pub(crate) fn new(nodes: &[(f64, f64)], ends: [EndSlope; 2]) -> Self {
        let secants: Vec<f64> = nodes
            .windows(2)
            .map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0))
            .collect();
        let last = nodes.len() - 1;
        let end = |slope: EndSlope, secant: Option<&f64>| match slope {
            EndSlope::Still => 0.0,
            EndSlope::Secant => secant.copied().unwrap_or(0.0),
        };
        let slope = |i: usize| match i {
            0 => end(ends[0], secants.first()),
            _ if i == last => end(ends[1], secants.last()),
            _ => {
                let lengths = [nodes[i].0 - nodes[i - 1].0, nodes[i + 1].0 - nodes[i].0];
                inner_slope([secants[i - 1], secants[i]], lengths)
            }
        };
        let node = |(i, &(time, value)): (usize, &(f64, f64))| Node {
            time,
            value,
            slope: slope(i),
        };
        Curve {
            nodes: nodes.iter().enumerate().map(node).collect(),
        }
    }

    /// The value at `time`.
    pub(crate) fn at(&self, time: f64) -> f64 {
        let after = self.nodes.partition_point(|node| node.time <= time);
        match (after.checked_sub(1), self.nodes.get(after)) {
            (Some(before), Some(next)) => between(&self.nodes[before], next, time),
            (Some(before), None) => self.nodes[before].value,
            (None, _) => self.nodes[0].value,
        }
    }

    /// The integral of the value over time from `from` to `to`.
    pub(crate) fn integral(&self, from: f64, to: f64) -> f64 {
        self.integral_to(to) - self.integral_to(from)
    }

    /// The integral from the first node to `time`; negative before it.
    fn integral_to(&self, time: f64) -> f64 {
        let first = &self.nodes[0];
        let last = &self.nodes[self.nodes.len() - 1];
        let outside =
            first.value * (time - first.time).min(0.0) + last.value * (time - last.time).max(0.0);
        let spans = self.nodes.windows(2);
        let inside = spans.map(|pair| integral_between(&pair[0], &pair[1], time));
        outside + inside.sum::<f64>()
    }
}

/// The weighted harmonic mean of the slopes of two neighbouring secants, of spans of these lengths.
fn inner_slope([before, after]: [f64; 2], [h0, h1]: [f64; 2]) -> f64 {
    if before * after <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (h0 + 2.0 * h1, 2.0 * h0 + h1);
    // The larger weight is that of the secant of the shorter span.
    (w0 + w1) / (w0 / before + w1 / after)
}

/// The coefficients of the polynomial in s = (time − a.time) / h from 0 to 1, and h.
fn cubic(a: &Node, b: &Node) -> ([f64; 4], f64) {
    let h = b.time - a.time;
    let (rise, m0, m1) = (b.value - a.value, a.slope * h, b.slope * h);
    let coefficients = [
        a.value,
        m0,
        3.0 * rise - 2.0 * m0 - m1,
        m0 + m1 - 2.0 * rise,
    ];
    (coefficients, h)
}

fn between(a: &Node, b: &Node, time: f64) -> f64 {
    let ([c0, c1, c2, c3], h) = cubic(a, b);
    let s = (time - a.time) / h;
    let value = c0 + s * (c1 + s * (c2 + s * c3));
    // Rounding must not leave the range of the nodes, which may be the range of what is possible.
    value.clamp(a.value.min(b.value), a.value.max(b.value))
}

/// The integral from a.time to `time`, which counts as at least a.time and at most b.time.
fn integral_between(a: &Node, b: &Node, time: f64) -> f64 {
    let ([c0, c1, c2, c3], h) = cubic(a, b);
    let s = ((time - a.time) / h).clamp(0.0, 1.0);
    h * s * (c0 + s * (c1 / 2.0 + s * (c2 / 3.0 + s * c3 / 4.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const STILL: [EndSlope; 2] = [EndSlope::Still; 2];
    const SECANT: [EndSlope; 2] = [EndSlope::Secant; 2];

    #[test]
    fn it_goes_through_its_nodes_and_stays_outside() {
        let curve = Curve::new(&[(1.0, 5.0), (2.0, 7.0), (4.0, -1.0)], STILL);
        for (time, value) in [(0.0, 5.0), (1.0, 5.0), (2.0, 7.0), (4.0, -1.0), (9.0, -1.0)] {
            assert_eq!(curve.at(time), value, "{time}");
        }
        assert_eq!(Curve::new(&[(1.0, 5.0)], SECANT).at(3.0), 5.0);
    }

    #[test]
    fn two_nodes_make_a_line_or_a_gentle_step() {
        let nodes = [(0.0, 350.0), (2.0, 370.0)];
        let line = Curve::new(&nodes, SECANT);
        let gentle = Curve::new(&nodes, STILL);
        for (time, on_line, on_gentle) in [(0.5, 355.0, 353.125), (1.0, 360.0, 360.0)] {
            assert!((line.at(time) - on_line).abs() < 1e-12);
            assert!((gentle.at(time) - on_gentle).abs() < 1e-12);
        }
    }

    /// Nodes at growing times.
    fn nodes() -> impl Strategy<Value = Vec<(f64, f64)>> {
        let step = (
            0.01..3.0f64,
            prop_oneof![-10.0..10.0f64, Just(0.0), Just(1.0)],
        );
        prop::collection::vec(step, 2..8).prop_map(|steps| {
            let mut time = 0.0;
            let at = |(step, value): (f64, f64)| {
                time += step;
                (time, value)
            };
            steps.into_iter().map(at).collect()
        })
    }

    proptest! {
        #[test]
        fn it_stays_between_its_nodes_and_has_no_kink(nodes in nodes(), steady: bool) {
            let curve = Curve::new(&nodes, if steady { SECANT } else { STILL });
            for pair in nodes.windows(2) {
                let ((t0, a), (t1, b)) = (pair[0], pair[1]);
                let mut before = a;
                for i in 1..=50 {
                    let value = curve.at(t0 + (t1 - t0) * f64::from(i) / 50.0);
                    prop_assert!((value - before) * (b - a) >= -1e-9, "{value} after {before}");
                    before = value;
                }
            }
            for &(time, _) in &nodes[1..nodes.len() - 1] {
                let h = 1e-7;
                let [left, here, right] = [-h, 0.0, h].map(|h| curve.at(time + h));
                // The curvature is at most 2e6; a kink by a slope of 1 would be 1e-7.
                prop_assert!(((right - here) - (here - left)).abs() < 5e-8);
            }
        }

        #[test]
        fn its_integral_is_that_of_its_values(nodes in nodes(), from in -1.0..8.0f64, length in 0.0..9.0f64) {
            let curve = Curve::new(&nodes, STILL);
            const STEPS: u32 = 20_000;
            let step = length / f64::from(STEPS);
            let sum: f64 = (0..STEPS).map(|i| curve.at(from + (f64::from(i) + 0.5) * step)).sum();
            prop_assert!((curve.integral(from, from + length) - sum * step).abs() < 1e-4);
        }
    }
}
