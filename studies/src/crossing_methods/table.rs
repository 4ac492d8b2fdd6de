//! Tables over two coordinates, in f32, read with bilinear interpolation as a GPU's sampler does, or with cubics through
//! four texels in each direction.

use super::{CrossingInfo, Kind, Orbit};
use lensbake_core::rk4;

/// The coordinates of a table, and what it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// u over 1/(1 + 6/b²) and ψ/ψ_max, with ψ_max a bound on the phase at u = 1/3: the coordinates of Bruneton.
    Bruneton,
    /// u/σ over ψ and σ = ψ/b: smooth, with no edge at the critical impact parameter.
    Ratio,
}

/// How a table is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// From two texels in each direction.
    Bilinear,
    /// From four texels in each direction, by Lagrange's cubic.
    Bicubic,
}

/// Greatest phase and σ of [`Axes::Ratio`]: a ray that turns round at r = 3 has 2.27 and 0.62.
const RATIO_ENDS: [f64; 2] = [2.4, 0.65];
/// Steps of the integration to a texel of [`Axes::Ratio`].
const STEPS: u32 = 64;
/// Steps of the integration from texel to texel of [`Axes::Bruneton`].
const STEPS_BETWEEN: u32 = 32;

/// A table.
#[derive(Debug, Clone)]
pub struct Table {
    axes: Axes,
    reading: Reading,
    /// Texels along the first and the second coordinate.
    size: [usize; 2],
    /// The second coordinate runs fastest.
    texels: Vec<f32>,
}

impl Table {
    /// The table of this size.
    pub fn new(axes: Axes, reading: Reading, size: [usize; 2]) -> Self {
        let part = |index: usize, count: usize| index as f64 / (count - 1) as f64;
        let row = |i: usize| match axes {
            Axes::Bruneton => bruneton_row(part(i, size[0]), size[1]),
            Axes::Ratio => (0..size[1])
                .map(|j| {
                    ratio(
                        RATIO_ENDS[0] * part(i, size[0]),
                        RATIO_ENDS[1] * part(j, size[1]),
                    )
                })
                .collect(),
        };
        Table {
            axes,
            reading,
            size,
            texels: (0..size[0]).flat_map(row).map(|u| u as f32).collect(),
        }
    }

    /// The interpolated texel at two coordinates from 0 to 1.
    fn read(&self, first: f32, second: f32) -> f32 {
        match self.reading {
            Reading::Bilinear => self.bilinear(first, second),
            Reading::Bicubic => self.bicubic(first, second),
        }
    }

    /// The index of the texel below a coordinate, from `margin` to that from its other end, and the distance from it.
    fn place(coordinate: f32, count: usize, margin: usize) -> (usize, f32) {
        let position = coordinate * (count - 1) as f32;
        let index = (position.max(0.0) as usize).clamp(margin, count - 2 - margin);
        (index, position - index as f32)
    }

    fn bilinear(&self, first: f32, second: f32) -> f32 {
        let (i, s) = Self::place(first, self.size[0], 0);
        let (j, t) = Self::place(second, self.size[1], 0);
        let along = |i: usize| {
            let at = i * self.size[1] + j;
            self.texels[at] + t * (self.texels[at + 1] - self.texels[at])
        };
        let (low, high) = (along(i), along(i + 1));
        low + s * (high - low)
    }

    fn bicubic(&self, first: f32, second: f32) -> f32 {
        let (i, s) = Self::place(first, self.size[0], 1);
        let (j, t) = Self::place(second, self.size[1], 1);
        let (across, along) = (cubic_weights(s), cubic_weights(t));
        let mut sum = 0.0;
        for (k, weight) in across.into_iter().enumerate() {
            let at = (i + k - 1) * self.size[1] + j - 1;
            let texels = &self.texels[at..at + 4];
            let row = along
                .iter()
                .zip(texels)
                .map(|(weight, texel)| weight * texel);
            sum += weight * row.sum::<f32>();
        }
        sum
    }
}

/// Lagrange's weights of the points −1, 0, 1, 2 at `t`.
fn cubic_weights(t: f32) -> [f32; 4] {
    let (below, above, last) = (t + 1.0, t - 1.0, t - 2.0);
    [
        -t * above * last / 6.0,
        0.5 * below * above * last,
        -0.5 * below * t * last,
        below * t * above / 6.0,
    ]
}

impl Orbit for Table {
    type Number = f32;

    fn info(&self) -> CrossingInfo {
        let reading = match self.reading {
            Reading::Bilinear => "bilinear",
            Reading::Bicubic => "bicubic",
        };
        CrossingInfo {
            kind: Kind::Table,
            name: match self.axes {
                Axes::Bruneton => "table of u",
                Axes::Ratio => "table of u b/ψ",
            },
            knobs: format!("{} × {} {reading}", self.size[0], self.size[1]),
            source: match self.axes {
                Axes::Bruneton => "Bruneton 2020, black_hole_shader",
                Axes::Ratio => "this project",
            },
            used: false,
        }
    }

    fn inverse_radius(&self, inv_b: f32, phase: f32) -> f32 {
        match self.axes {
            Axes::Bruneton => {
                let square = inv_b * inv_b;
                let most = (1.0 + square) / (1.0 / 3.0 + 2.0 * square * inv_b);
                self.read(1.0 / (1.0 + 6.0 * square), phase / most)
            }
            Axes::Ratio => {
                let [phase_end, sigma_end] = RATIO_ENDS.map(|end| 1.0 / end as f32);
                let sigma = inv_b * phase;
                sigma * self.read(phase * phase_end, sigma * sigma_end)
            }
        }
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.texels[..])
    }
}

fn binet(y: &[f64; 2]) -> [f64; 2] {
    [y[1], 1.5 * y[0] * y[0] - y[0]]
}

/// u at `count` phases from 0 to the bound, at the first coordinate `first` from 0 to 1.
fn bruneton_row(first: f64, count: usize) -> Vec<f64> {
    // Straight into the hole, u is half of the second coordinate.
    let square = (1.0 / first - 1.0) / 6.0;
    if square.is_infinite() {
        return (0..count)
            .map(|j| 0.5 * j as f64 / (count - 1) as f64)
            .collect();
    }
    let inv_b = square.sqrt();
    let most = (1.0 + square) / (1.0 / 3.0 + 2.0 * square * inv_b);
    let h = most / ((count - 1) as f64 * f64::from(STEPS_BETWEEN));
    let mut y = [0.0, inv_b];
    (0..count)
        .map(|j| {
            let steps = if j == 0 { 0 } else { STEPS_BETWEEN };
            for _ in 0..steps {
                y = rk4::step(&binet, &y, h);
            }
            y[0]
        })
        .collect()
}

/// u/σ at a phase and σ; 1 at the phase 0.
fn ratio(phase: f64, sigma: f64) -> f64 {
    if phase == 0.0 {
        return 1.0;
    }
    // The limit of a small σ does not depend on it.
    let sigma = sigma.max(1e-9);
    let mut y = [0.0, sigma / phase];
    for _ in 0..STEPS {
        y = rk4::step(&binet, &y, phase / f64::from(STEPS));
    }
    y[0] / sigma
}
