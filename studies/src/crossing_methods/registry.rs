//! All methods that find the radius of a crossing.

use super::CrossingMethod;
use super::integrated::{Leapfrog, Rk4};
use super::jacobi::Jacobi;
use super::table::{Axes, Reading, Table};
use super::weierstrass::Weierstrass;

/// Sizes of the tables; Bruneton's has 64 × 32 texels.
const SIZES: [[usize; 2]; 5] = [[32, 16], [64, 32], [128, 64], [256, 128], [512, 256]];

/// Every method, those along a curve of the figure in its order.
pub fn all() -> Vec<Box<dyn CrossingMethod>> {
    let mut methods: Vec<Box<dyn CrossingMethod>> = vec![
        Box::new(Weierstrass::<f32, 0>::default()),
        Box::new(Weierstrass::<f32, 1>::default()),
        Box::new(Weierstrass::<f32, 2>::default()),
        Box::new(Weierstrass::<f32, 3>::default()),
        Box::new(Weierstrass::<f64, 0>::default()),
        Box::new(Weierstrass::<f64, 1>::default()),
        Box::new(Weierstrass::<f64, 2>::default()),
        Box::new(Weierstrass::<f64, 3>::default()),
        Box::new(Jacobi::<f32>::default()),
        Box::new(Jacobi::<f64>::default()),
    ];
    for steps in [4, 8, 16, 32] {
        methods.push(Box::new(Rk4::<f32>::new(steps)));
        methods.push(Box::new(Rk4::<f64>::new(steps)));
        methods.push(Box::new(Leapfrog::<f32>::new(4 * steps)));
    }
    for axes in [Axes::Bruneton, Axes::Ratio] {
        for reading in [Reading::Bilinear, Reading::Bicubic] {
            for size in SIZES {
                methods.push(Box::new(Table::new(axes, reading, size)));
            }
        }
    }
    methods
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crossing_methods::{Kind, Questions, label};
    use lensbake_core::orbit;
    use std::collections::BTreeSet;

    /// Phases of u = 1/12 to 1/3 of rays on both sides of the critical impact parameter.
    fn questions() -> Questions {
        let inv_bs = [1e-1, 0.192, 0.1925, 0.25, 0.27, 0.5, 2.0, 50.0];
        let pairs = inv_bs.into_iter().flat_map(|inv_b: f64| {
            (0..20).filter_map(move |i| {
                let u = 1.0 / 12.0 + f64::from(i) / 80.0;
                Some([inv_b as f32, orbit::phase(inv_b, u)? as f32])
            })
        });
        Questions::new(pairs.collect())
    }

    #[test]
    fn every_method_has_a_name_of_its_own() {
        let methods = all();
        let labels: BTreeSet<String> = methods.iter().map(|m| label(m.as_ref())).collect();
        assert_eq!(labels.len(), methods.len());
        assert_eq!(methods.iter().filter(|m| m.info().used).count(), 2);
    }

    #[test]
    fn every_method_computes_the_inverse_radius() {
        let questions = questions();
        assert!(questions.pairs().len() > 100);
        for method in all() {
            let allowed = match (method.info().kind, method.bits()) {
                (Kind::Weierstrass, 64) => 1e-6,
                (Kind::Weierstrass, _) => 2e-6,
                (Kind::Jacobi, 64) => 1e-11,
                (Kind::Jacobi, _) => 1e-4,
                (Kind::Table | Kind::Integrated, _) => 0.02,
            };
            for (&[inv_b, phase], u) in questions.pairs().iter().zip(method.answers(&questions)) {
                let off = u / orbit::inverse_radius(inv_b, phase) - 1.0;
                let name = label(method.as_ref());
                assert!(off.abs() < allowed, "{name}: {inv_b} {phase} {off}");
            }
        }
    }

    #[test]
    fn the_copy_of_the_closed_form_is_that_of_core() {
        let questions = questions();
        let copy = Weierstrass::<f64, 3>::default().answers(&questions);
        for (&[inv_b, phase], u) in questions.pairs().iter().zip(copy) {
            let off = u / orbit::inverse_radius(inv_b, phase) - 1.0;
            assert!(off.abs() < 1e-14, "{inv_b} {phase} {off}");
        }
    }
}
