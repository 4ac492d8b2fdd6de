//! Tables of one row: an axis, an interpolation, a number of texels and a storage format.

use super::filter_weight::filter_weight;
use super::row_axis::RowAxis;
use super::row_store::{Format, Store, Texels};
use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use lensbake_core::rk4::Stepper;
use lensbake_core::{Observer, direct};
use lensbake_tables::Axis;
use lensbake_tables::interpolation::{chord, cubic, cubic_coefficients, horner};

/// How a value between texels is interpolated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// The nearest texel.
    Nearest,
    /// Linear between two texels.
    Linear,
    /// Linear, with the weight rounded to 8 bits as in GPU samplers.
    LinearFilter8,
    /// Cubic Hermite between two texels, with the stored slopes.
    Hermite,
    /// The same cubic from one texel, which holds its four coefficients.
    CubicCoefficients,
}

impl Interpolation {
    /// All interpolations.
    pub const ALL: [Interpolation; 5] = [
        Interpolation::Nearest,
        Interpolation::Linear,
        Interpolation::LinearFilter8,
        Interpolation::Hermite,
        Interpolation::CubicCoefficients,
    ];

    /// Name in the CSV files and the figures.
    pub fn name(self) -> &'static str {
        match self {
            Interpolation::Nearest => "nearest",
            Interpolation::Linear => "linear",
            Interpolation::LinearFilter8 => "linear, 8-bit weights",
            Interpolation::Hermite => "Hermite",
            Interpolation::CubicCoefficients => "cubic coefficients",
        }
    }
}

/// Values and slopes per texel at the nodes, in f64. Rows of every format are made from them.
#[derive(Debug, Clone, PartialEq)]
pub struct Nodes {
    axis: RowAxis,
    observer: Observer,
    values: Vec<[f64; 2]>,
}

/// The texel at the shadow's edge holds the limit q → 0. It is computed at this q, where the value differs from
/// the limit by about q².
const EDGE_Q: f64 = 1e-6;
/// Tolerance of the integrator that computes the nodes, rad per radian of orbital angle.
const TOLERANCE: f64 = 1e-11;

impl Nodes {
    /// `texels` nodes along `axis` for `observer`, integrated by the shared RK4 core.
    pub fn new(axis: RowAxis, observer: Observer, texels: usize) -> Self {
        let last = (texels - 1) as f64;
        let node = |i| {
            let q: f64 = i as f64 / last;
            let at_edge = axis.starts_at_shadow_edge() && i == 0;
            let q = if at_edge { EDGE_Q } else { q };
            let at = axis.coordinate(q);
            let bending = direct::bend_and_slope(&observer, at, Stepper::Adaptive(TOLERANCE));
            let Some(bending) = bending.escaped() else {
                return [f64::NAN; 2];
            };
            let stored = axis.stored(&observer, q, bending);
            let slope = if at_edge { 0.0 } else { stored.slope / last };
            [stored.value, slope]
        };
        Nodes {
            axis,
            observer,
            values: (0..texels).map(node).collect(),
        }
    }

    /// The texels for `interpolation`, rounded to `format`.
    fn stored(&self, interpolation: Interpolation, format: Format) -> Store {
        match interpolation {
            Interpolation::Nearest | Interpolation::Linear | Interpolation::LinearFilter8 => {
                let values: Vec<_> = self.values.iter().map(|&[value, _]| [value]).collect();
                Store::new(&values, format)
            }
            Interpolation::Hermite => Store::new(&self.values, format),
            Interpolation::CubicCoefficients => Store::new(&self.coefficients(), format),
        }
    }

    /// The coefficients of the cubic after each node. After the last node there is none, only its value and slope.
    fn coefficients(&self) -> Vec<[f64; 4]> {
        let intervals = self.values.windows(2);
        let last = self
            .values
            .last()
            .map(|&[value, slope]| [value, slope, 0.0, 0.0]);
        intervals
            .map(|ends| cubic_coefficients(ends[0], ends[1]))
            .chain(last)
            .collect()
    }
}

/// A row in one format, with one way to interpolate.
#[derive(Debug, Clone, PartialEq)]
pub struct RowTable {
    axis: RowAxis,
    observer: Observer,
    interpolation: Interpolation,
    format: Format,
    texels: usize,
    store: Store,
}

impl RowTable {
    /// The row made from `nodes`.
    pub fn new(nodes: &Nodes, interpolation: Interpolation, format: Format) -> Self {
        RowTable {
            axis: nodes.axis,
            observer: nodes.observer,
            interpolation,
            format,
            texels: nodes.values.len(),
            store: nodes.stored(interpolation, format),
        }
    }

    /// The interpolated value at `position`, in texels.
    fn value(&self, position: f64) -> f64 {
        match &self.store {
            Store::F16(texels) => self.interpolate(texels.as_slice(), position),
            Store::Unorm16(texels) => self.interpolate(texels, position),
            Store::F32(texels) => self.interpolate(texels.as_slice(), position),
        }
    }

    fn interpolate(&self, texels: &(impl Texels + ?Sized), position: f64) -> f64 {
        if self.interpolation == Interpolation::Nearest {
            let [value] = texels.texel((position + 0.5) as usize);
            return value;
        }
        let i = (position as usize).min(self.texels - 2);
        let t = position - i as f64;
        let line = |t: f64| {
            let value = |i: usize| [texels.texel::<1>(i)[0], 0.0];
            chord(value(i), value(i + 1), t)[0]
        };
        match self.interpolation {
            Interpolation::Nearest | Interpolation::Linear => line(t),
            Interpolation::LinearFilter8 => line(filter_weight(t)),
            Interpolation::Hermite => cubic(texels.texel(i), texels.texel(i + 1), t)[0],
            Interpolation::CubicCoefficients => horner(texels.texel(i), t)[0],
        }
    }

    /// Whether readers will look for this table: the naive ones as most programs have them, and the default row in
    /// other formats.
    fn is_landmark(&self) -> bool {
        let naive = !self.axis.starts_at_shadow_edge();
        match (self.interpolation, self.format) {
            (Interpolation::Linear, Format::F32) => naive && self.texels == 1024,
            (Interpolation::Hermite, Format::F16 | Format::Unorm16)
            | (Interpolation::CubicCoefficients, Format::F32) => {
                self.axis == RowAxis::Baked(Axis::Residual) && self.texels == 64
            }
            _ => false,
        }
    }
}

impl BendingMethod for RowTable {
    fn info(&self) -> MethodInfo {
        let (interpolation, format) = (self.interpolation.name(), self.format.name());
        MethodInfo {
            name: format!("table: {}", self.axis.name()),
            knobs: format!("{interpolation}, {} × {format}", self.texels),
            source: match self.axis {
                RowAxis::Baked(Axis::Residual) | RowAxis::ResidualS => "this project",
                RowAxis::Baked(_) => "textbook sampling",
            },
            family: Family::Table,
            landmark: self.is_landmark(),
        }
    }

    fn bytes(&self) -> usize {
        self.store.bytes()
    }

    fn serves(&self, observer: &Observer) -> bool {
        self.observer == *observer
    }

    fn bend(&self, initial: &InitialConditions) -> MethodOutcome {
        let at = initial.at;
        if at.one_minus_x <= 0.0 {
            return MethodOutcome::Captured;
        }
        let q = self.axis.position(at).clamp(0.0, 1.0);
        let value = self.value(q * (self.texels - 1) as f64);
        MethodOutcome::Escapes(self.axis.bend(&self.observer, at, value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_core::{Ray, exact};

    fn largest_error(axis: RowAxis, interpolation: Interpolation, format: Format) -> f64 {
        let nodes = Nodes::new(axis, Observer::at_infinity(), 256);
        let table = RowTable::new(&nodes, interpolation, format);
        (0..500)
            .map(|i| 2.7 * 30f64.powf(f64::from(i) / 500.0))
            .map(|b| {
                let closed = exact::bend(&Ray::from_infinity(b).unwrap());
                let bend = table.bend(&InitialConditions::from_infinity(b)).bend();
                (bend.unwrap() - closed.escaped().unwrap()).abs()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn each_axis_answers_and_better_interpolation_is_better() {
        let (b_min, b_max) = (2.6, 100.0);
        let axes = [
            RowAxis::ResidualS,
            RowAxis::Baked(Axis::Residual),
            RowAxis::Baked(Axis::UniformLogB { b_min, b_max }),
            RowAxis::Baked(Axis::UniformInverseB { b_min, b_max }),
        ];
        for axis in axes {
            let [nearest, linear, filter8, hermite, coefficients] =
                Interpolation::ALL.map(|i| largest_error(axis, i, Format::F32));
            assert!(linear < 0.5 * nearest, "{axis:?}");
            assert!(linear < filter8, "{axis:?}");
            assert!(hermite < 0.5 * linear, "{axis:?}");
            let f16 = largest_error(axis, Interpolation::Hermite, Format::F16);
            assert!(hermite < f16 && f16 < 0.02, "{axis:?}: {f16:e}");
            if axis.starts_at_shadow_edge() {
                let off = (coefficients - hermite).abs();
                assert!(off < 0.05 * hermite + 2e-8, "{axis:?}: {coefficients:e}");
                let unorm16 = largest_error(axis, Interpolation::Hermite, Format::Unorm16);
                assert!(
                    hermite < unorm16 && unorm16 < 0.2 * f16,
                    "{axis:?}: {unorm16:e}"
                );
            }
        }
    }

    #[test]
    fn uniform_in_b_is_off_by_radians() {
        let (b_min, b_max) = super::super::registry::B_RANGE;
        let axis = RowAxis::Baked(Axis::UniformB { b_min, b_max });
        let nodes = Nodes::new(axis, Observer::at_infinity(), 1024);
        let table = RowTable::new(&nodes, Interpolation::Linear, Format::F32);
        let ray = Ray::from_infinity(2.65).unwrap();
        let closed = exact::bend(&ray).escaped().unwrap();
        let bend = table
            .bend(&InitialConditions::from_infinity(2.65))
            .bend()
            .unwrap();
        assert!((bend - closed).abs() > 3.0, "{bend} against {closed}");
    }
}
