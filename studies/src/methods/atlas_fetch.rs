//! The simplest lookup: one bilinear fetch from the whole atlas, as a GPU's sampler does it.

use super::filter_weight::{bilinear, texel_and_weight};
use super::{BendingMethod, Family, InitialConditions, MethodInfo, MethodOutcome};
use half::f16;
use lensbake_core::Observer;
use lensbake_tables::{Axis, default_atlas};
use std::f64::consts::FRAC_PI_2;

/// The values of the shipped atlas above the horizon as a texture of half floats. A fetch interpolates linearly in
/// both directions, with the 8-bit weights of a sampler: along a row (q) and between rows (χ, 1/r = sin²χ). No row
/// is made for the observer, and no slopes are needed.
#[derive(Debug, Clone)]
pub struct AtlasFetch {
    axis: Axis,
    observer: Observer,
    /// The row before the observer, and the weight of the next one.
    row: (usize, f64),
    /// Array of shape `[rows][columns]`.
    values: Vec<f16>,
    columns: usize,
}

impl AtlasFetch {
    /// The fetch for `observer`; `None` unless it is at rest above the horizon, where the rows are uniform in χ.
    pub fn new(observer: Observer) -> Option<Self> {
        if observer.is_inside() || !observer.is_at_rest() {
            return None;
        }
        let atlas = default_atlas();
        let rows = atlas.header().rows_above();
        let values = (0..rows).flat_map(|row| atlas.row_texels(row));
        Some(AtlasFetch {
            axis: atlas.header().axis,
            observer,
            row: texel_and_weight(
                observer.chi() / FRAC_PI_2 * f64::from(rows - 1),
                rows as usize,
            ),
            values: values.map(|texel| f16::from_f32(texel[0])).collect(),
            columns: atlas.header().texels as usize,
        })
    }

    /// The bilinearly interpolated value at `column` (in texels).
    fn fetch(&self, column: f64) -> f64 {
        let value = |column: usize, row: usize| self.values[row * self.columns + column].into();
        bilinear(value, texel_and_weight(column, self.columns), self.row)
    }
}

impl BendingMethod for AtlasFetch {
    fn info(&self) -> MethodInfo {
        let rows = self.values.len() / self.columns;
        MethodInfo {
            name: "residual from the whole atlas".to_owned(),
            knobs: format!("one fetch, {} × {rows} × f16", self.columns),
            source: "this project",
            family: Family::Table,
            landmark: true,
        }
    }

    fn bytes(&self) -> usize {
        size_of_val(self.values.as_slice())
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
        let value = self.fetch(q * (self.columns - 1) as f64);
        MethodOutcome::Escapes(self.axis.bend(&self.observer, at, value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method_chart::rays::ChartObserver;

    #[test]
    fn one_fetch_is_off_by_less_than_a_thousandth_from_everywhere() {
        for observer in ChartObserver::ALL {
            let method = AtlasFetch::new(observer.observer()).unwrap();
            let errors = observer
                .rays(2_000, 1)
                .into_iter()
                .map(|ray| ray.error(method.bend(&ray.initial)).radians.abs());
            let largest = errors.fold(0.0, f64::max);
            assert!((1e-5..2e-3).contains(&largest), "{observer:?}: {largest:e}");
        }
    }

    #[test]
    fn only_observers_at_rest_above_the_horizon_have_one() {
        assert!(AtlasFetch::new(Observer::at(1.5).unwrap()).is_some());
        assert!(AtlasFetch::new(Observer::falling(1.5).unwrap()).is_none());
        assert!(AtlasFetch::new(Observer::falling(0.5).unwrap()).is_none());
    }
}
