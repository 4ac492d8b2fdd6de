//! All methods, constructed for one observer.

use super::BendingMethod;
use super::atlas_fetch::AtlasFetch;
use super::bholetrace::{BholetraceEquation, BholetraceSearch};
use super::closed_form::ClosedForm;
use super::default_row::DefaultRow;
use super::dormand_prince::DormandPrince;
use super::far_model::FarModel;
use super::leapfrog::Leapfrog;
use super::quadrature::Quadrature;
use super::rk4_adaptive::Rk4Adaptive;
use super::rk4_fixed::Rk4Fixed;
use super::row_axis::RowAxis;
use super::row_batch::{Precision, RowInBatches};
use super::row_store::Format;
use super::row_table::{Interpolation, Nodes, RowTable};
use super::semi_implicit_euler::SemiImplicitEuler;
use super::series::{StrongLimit, WeakSeries};
use lensbake_core::{B_CRIT, Observer};
use lensbake_tables::{Axis, TableError};
use rayon::prelude::*;

/// The range of b of the naive axes: b/b_c − 1 from 1e-6 to 100, as for the rays.
pub const B_RANGE: (f64, f64) = (B_CRIT * (1.0 + 1e-6), B_CRIT * 101.0);

/// Sizes of the tables: 16, 32, … 4096 texels.
pub fn texel_counts() -> impl Iterator<Item = usize> {
    (4..=12).map(|power| 1 << power)
}

/// The axes of the compared tables.
pub fn axes() -> [RowAxis; 5] {
    let (b_min, b_max) = B_RANGE;
    [
        RowAxis::Baked(Axis::UniformB { b_min, b_max }),
        RowAxis::Baked(Axis::UniformInverseB { b_min, b_max }),
        RowAxis::Baked(Axis::UniformLogB { b_min, b_max }),
        RowAxis::ResidualS,
        RowAxis::Baked(Axis::Residual),
    ]
}

/// A list of methods.
pub type Methods = Vec<Box<dyn BendingMethod>>;

/// Every method that serves `observer`, the default row first.
///
/// # Errors
/// [`TableError`] if the shipped atlas has no row for `observer`; it has one for every observer.
pub fn all(observer: Observer) -> Result<Methods, TableError> {
    let mut methods = without_compared_tables(observer)?;
    methods.extend(tables(observer));
    Ok(methods)
}

/// The methods that serve `observer`, without tables other than the default row, its lookups of many rays and
/// [`AtlasFetch`].
///
/// # Errors
/// As [`all`].
pub fn without_compared_tables(observer: Observer) -> Result<Methods, TableError> {
    let mut methods: Methods = vec![Box::new(DefaultRow::new(observer)?)];
    for precision in [Precision::Double, Precision::Single] {
        methods.push(Box::new(RowInBatches::new(observer, precision)?));
    }
    if let Some(fetch) = AtlasFetch::new(observer) {
        methods.push(Box::new(fetch));
    }
    methods.extend(computed());
    methods.retain(|method| method.serves(&observer));
    Ok(methods)
}

/// The methods without a table: integrators, closed forms and [`FarModel`].
pub fn computed() -> Methods {
    let mut methods: Methods = vec![
        Box::new(ClosedForm),
        Box::new(WeakSeries),
        Box::new(StrongLimit),
        Box::new(FarModel),
        Box::new(BholetraceSearch {
            equation: BholetraceEquation::Report,
        }),
        Box::new(BholetraceSearch {
            equation: BholetraceEquation::Shader,
        }),
    ];
    for h in [0.1, 0.03, 0.01, 0.003] {
        methods.push(Box::new(Rk4Fixed::<f32>::new(h)));
        methods.push(Box::new(Rk4Fixed::<f64>::new(h)));
    }
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        methods.push(Box::new(Rk4Adaptive { tolerance }));
        methods.push(Box::new(DormandPrince { tolerance }));
    }
    for h in [0.01, 0.001] {
        methods.push(Box::new(SemiImplicitEuler { h }));
    }
    for step_over_r in [0.1, 0.03, 0.01] {
        methods.push(Box::new(Leapfrog { step_over_r }));
    }
    for points in [4, 8, 16, 32, 64, 128] {
        if let Some(quadrature) = Quadrature::new(points) {
            methods.push(Box::new(quadrature));
        }
    }
    methods
}

/// The interpolations and formats of the compared tables along `axis`. Along the naive axes, whose spacing limits the
/// error, there are no 16-bit integers and no cubic coefficients.
fn variants(axis: RowAxis) -> impl Iterator<Item = (Interpolation, Format)> {
    let all = Interpolation::ALL.into_iter().flat_map(|interpolation| {
        Format::ALL
            .into_iter()
            .map(move |format| (interpolation, format))
    });
    let residual = axis.starts_at_shadow_edge();
    all.filter(move |&(interpolation, format)| {
        let fast = interpolation == Interpolation::CubicCoefficients || format == Format::Unorm16;
        residual || !fast
    })
}

/// Tables of all axes × texels × [`variants`], except the combination of the default row.
fn tables(observer: Observer) -> Methods {
    let mut rows: Vec<(RowAxis, usize)> = Vec::new();
    for axis in axes().into_iter().filter(|axis| axis.serves(&observer)) {
        rows.extend(texel_counts().map(|texels| (axis, texels)));
    }
    rows.into_par_iter()
        .flat_map_iter(|(axis, texels)| {
            let nodes = Nodes::new(axis, observer, texels);
            variants(axis)
                .filter(move |&(interpolation, format)| {
                    !is_default(axis, interpolation, texels, format)
                })
                .map(move |(interpolation, format)| {
                    Box::new(RowTable::new(&nodes, interpolation, format)) as Box<dyn BendingMethod>
                })
        })
        .collect()
}

/// Whether this is the default row, which [`DefaultRow`] measures through the product's own code.
fn is_default(axis: RowAxis, interpolation: Interpolation, texels: usize, format: Format) -> bool {
    axis == RowAxis::Baked(Axis::Residual)
        && interpolation == Interpolation::Hermite
        && format == Format::F32
        && texels == lensbake_tables::default_atlas().header().texels as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::Family;
    use std::collections::BTreeSet;

    #[test]
    fn every_method_has_a_name_of_its_own_and_a_source() {
        let methods = all(Observer::at_infinity()).unwrap();
        let labels: BTreeSet<String> = methods.iter().map(|m| m.info().label()).collect();
        assert_eq!(labels.len(), methods.len());
        assert!(methods.iter().all(|m| !m.info().source.is_empty()));
        let tables = methods.iter().filter(|m| m.info().family == Family::Table);
        // Three naive axes, two residual ones, the fetch from the atlas and two lookups of many rays; the default row is
        // one of the tables.
        assert_eq!(tables.count(), 3 * 9 * 4 * 2 + 2 * 9 * 5 * 3 + 3);
        assert_eq!(methods.len(), 521);
    }

    #[test]
    fn finite_observers_have_the_model_and_their_own_rows() {
        let methods = all(Observer::at(10.0).unwrap()).unwrap();
        let families = methods.iter().filter(|m| m.info().family == Family::Model);
        assert_eq!(families.count(), 1);
        let tables = methods.iter().filter(|m| m.info().family == Family::Table);
        assert_eq!(tables.count(), 2 * 9 * 5 * 3 + 3);
    }
}
