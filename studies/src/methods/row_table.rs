//! Tables of one row: an axis, an interpolation, a number of texels and a storage format.

use super::row_axis::RowAxis;
use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use half::f16;
use lensbake_core::rk4::Stepper;
use lensbake_core::{Observer, direct};
use lensbake_tables::interpolation::{chord, cubic};

/// How a value between texels is interpolated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// The nearest texel.
    Nearest,
    /// Linear between two texels.
    Linear,
    /// Linear, with the weight rounded to 8 bits as in GPU samplers (Vulkan 1.3, `subTexelPrecisionBits`).
    LinearFilter8,
    /// Cubic Hermite between two texels, with the stored slopes.
    Hermite,
}

impl Interpolation {
    /// All interpolations.
    pub const ALL: [Interpolation; 4] = [
        Interpolation::Nearest,
        Interpolation::Linear,
        Interpolation::LinearFilter8,
        Interpolation::Hermite,
    ];

    /// Name in the CSV files and the figures.
    pub fn name(self) -> &'static str {
        match self {
            Interpolation::Nearest => "nearest",
            Interpolation::Linear => "linear",
            Interpolation::LinearFilter8 => "linear, 8-bit weights",
            Interpolation::Hermite => "Hermite",
        }
    }

    /// Numbers per texel: the value, and for Hermite the slope.
    fn channels(self) -> usize {
        if self == Interpolation::Hermite { 2 } else { 1 }
    }
}

/// Storage format of the texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// 16-bit floats.
    F16,
    /// 32-bit floats.
    F32,
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
}

/// The numbers of a row in the order of its texels.
#[derive(Debug, Clone, PartialEq)]
enum Store {
    F16(Vec<f16>),
    F32(Vec<f32>),
}

impl Store {
    fn get(&self, i: usize) -> f64 {
        match self {
            Store::F16(numbers) => f64::from(numbers[i]),
            Store::F32(numbers) => f64::from(numbers[i]),
        }
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
        let numbers = nodes
            .values
            .iter()
            .flat_map(|texel| texel.iter().copied().take(interpolation.channels()));
        RowTable {
            axis: nodes.axis,
            observer: nodes.observer,
            interpolation,
            format,
            texels: nodes.values.len(),
            store: match format {
                Format::F16 => Store::F16(numbers.map(f16::from_f64).collect()),
                Format::F32 => Store::F32(numbers.map(|x| x as f32).collect()),
            },
        }
    }

    /// The interpolated value at `position`, in texels.
    fn value(&self, position: f64) -> f64 {
        let last = self.texels - 1;
        if self.interpolation == Interpolation::Nearest {
            return self.store.get((position + 0.5) as usize);
        }
        let i = (position as usize).min(last - 1);
        let t = position - i as f64;
        match self.interpolation {
            Interpolation::Hermite => self.hermite(i, t),
            Interpolation::LinearFilter8 => self.line(i, (t * 256.0).round() / 256.0),
            _ => self.line(i, t),
        }
    }

    fn line(&self, i: usize, t: f64) -> f64 {
        let value = |i: usize| [self.store.get(i), 0.0];
        chord(value(i), value(i + 1), t)[0]
    }

    fn hermite(&self, i: usize, t: f64) -> f64 {
        let texel = |i: usize| [self.store.get(2 * i), self.store.get(2 * i + 1)];
        cubic(texel(i), texel(i + 1), t)[0]
    }
}

impl BendingMethod for RowTable {
    fn info(&self) -> MethodInfo {
        let format = match self.format {
            Format::F16 => "f16",
            Format::F32 => "f32",
        };
        MethodInfo {
            name: format!("table: {}", self.axis.name()),
            knobs: format!("{}, {} × {format}", self.interpolation.name(), self.texels),
            source: match self.axis {
                RowAxis::Baked(lensbake_tables::Axis::Residual) | RowAxis::ResidualS => {
                    "this project"
                }
                RowAxis::Baked(_) => "textbook sampling",
            },
            family: Family::Table,
            landmark: self.texels == 1024
                && self.interpolation == Interpolation::Linear
                && self.format == Format::F32
                && !self.axis.starts_at_shadow_edge(),
        }
    }

    fn bytes(&self) -> usize {
        match &self.store {
            Store::F16(numbers) => size_of_val(numbers.as_slice()),
            Store::F32(numbers) => size_of_val(numbers.as_slice()),
        }
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
    use lensbake_tables::Axis;

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
            let [nearest, linear, filter8, hermite] =
                Interpolation::ALL.map(|i| largest_error(axis, i, Format::F32));
            assert!(linear < 0.5 * nearest, "{axis:?}");
            assert!(linear < filter8, "{axis:?}");
            assert!(hermite < 0.5 * linear, "{axis:?}");
            let f16 = largest_error(axis, Interpolation::Hermite, Format::F16);
            assert!(hermite < f16 && f16 < 0.02, "{axis:?}: {f16:e}");
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
