//! The methods of the stability atlas: one of each kind, with parameters that are good where it works.

use crate::methods::bholetrace::{BholetraceEquation, BholetraceSearch};
use crate::methods::closed_form::ClosedForm;
use crate::methods::default_row::DefaultRow;
use crate::methods::dormand_prince::DormandPrince;
use crate::methods::far_model::FarModel;
use crate::methods::leapfrog::Leapfrog;
use crate::methods::quadrature::Quadrature;
use crate::methods::registry::{Methods, axes};
use crate::methods::rk4_adaptive::Rk4Adaptive;
use crate::methods::rk4_fixed::Rk4Fixed;
use crate::methods::row_axis::RowAxis;
use crate::methods::row_store::Format;
use crate::methods::row_table::{Interpolation, Nodes, RowTable};
use crate::methods::semi_implicit_euler::SemiImplicitEuler;
use crate::methods::series::{StrongLimit, WeakSeries};
use crate::methods::{BendingMethod, MethodInfo};
use lensbake_core::Observer;
use lensbake_tables::{Axis, TableError};

/// Whether a method is this project's own.
pub fn is_product(info: &MethodInfo) -> bool {
    info.source.contains("this project:")
}

/// The methods, constructed for `observer`; always the same methods in the same order.
///
/// # Errors
/// [`TableError`] if the shipped atlas has no row for `observer`; it has one for every observer.
pub fn for_observer(observer: Observer) -> Result<Methods, TableError> {
    let mut methods: Methods = vec![
        Box::new(DefaultRow::new(observer)?),
        Box::new(Rk4Adaptive { tolerance: 1e-9 }),
        Box::new(ClosedForm),
        Box::new(Rk4Fixed::<f64>::new(0.01)),
        Box::new(Rk4Fixed::<f32>::new(0.01)),
        Box::new(DormandPrince { tolerance: 1e-12 }),
        Box::new(SemiImplicitEuler { h: 0.001 }),
        Box::new(Leapfrog { step_over_r: 0.01 }),
        Box::new(BholetraceSearch {
            equation: BholetraceEquation::Report,
        }),
        Box::new(BholetraceSearch {
            equation: BholetraceEquation::Shader,
        }),
        Box::new(WeakSeries),
        Box::new(StrongLimit),
        Box::new(FarModel),
    ];
    if let Some(quadrature) = Quadrature::new(32) {
        methods.push(Box::new(quadrature));
    }
    methods.extend(axes().into_iter().map(|axis| table(axis, observer)));
    Ok(methods)
}

/// A linear table of 1024 texels, or, of the shipped residual, of 256 texels with the 8-bit weights of a GPU's
/// sampler.
fn table(axis: RowAxis, observer: Observer) -> Box<dyn BendingMethod> {
    let observer = if axis.serves(&observer) {
        observer
    } else {
        Observer::at_infinity()
    };
    let (texels, interpolation) = match axis {
        RowAxis::Baked(Axis::Residual) => (256, Interpolation::LinearFilter8),
        _ => (1024, Interpolation::Linear),
    };
    let nodes = Nodes::new(axis, observer, texels);
    Box::new(RowTable::new(&nodes, interpolation, Format::F32))
}
