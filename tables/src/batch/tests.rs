use super::*;
use crate::default_atlas;
use lensbake_core::{B_CRIT, Observer, RayOutcome};
use proptest::prelude::*;

/// Rays in every direction: crowded at the edge of the shadow and straight away, within the shadow, at the ends.
fn coordinates() -> impl Strategy<Value = ShadowCoordinate> {
    let of_d = |one_minus_x: f64| ShadowCoordinate {
        x: 1.0 - one_minus_x,
        one_minus_x,
    };
    let of_x = |x: f64| ShadowCoordinate {
        x,
        one_minus_x: 1.0 - x,
    };
    prop_oneof![
        (0.0..1.0).prop_map(of_d),
        (-300.0..0.0).prop_map(move |log: f64| of_d(10f64.powf(log))),
        (-300.0..0.0).prop_map(move |log: f64| of_x(10f64.powf(log))),
        (1.0..1e3).prop_map(of_x),
        prop_oneof![
            Just(of_d(0.0)),
            Just(of_x(0.0)),
            Just(of_d(5e-324)),
            Just(of_x(f64::INFINITY)),
            Just(of_d(f64::NAN)),
        ],
    ]
}

/// Observers at rest and in free fall, from infinity to r = 0.01.
fn observers() -> impl Strategy<Value = Observer> {
    prop_oneof![
        Just(Observer::at_infinity()),
        (0.0..6.0f64).prop_map(|log| Observer::at(1.000_01 + log.exp_m1()).unwrap()),
        (-4.6..6.0f64).prop_map(|log| Observer::falling(log.exp()).unwrap()),
    ]
}

fn compare(row: &Row, at: &[ShadowCoordinate]) -> Result<(), TestCaseError> {
    let bends = row.bend_many(at);
    let mut bendings = vec![CAPTURED; at.len()];
    row.batch().bend_and_slope(at, &mut bendings);
    prop_assert_eq!(bends.len(), at.len());
    for ((&at, bend), bending) in at.iter().zip(bends).zip(bendings) {
        let (one, both) = (row.bend(at), row.bend_and_slope(at));
        match (one, both) {
            (RayOutcome::Captured, RayOutcome::Captured) => {
                prop_assert!(bend.is_nan() && bending.bend.is_nan() && bending.slope.is_nan());
            }
            (RayOutcome::Escapes(one), _) if one.is_nan() => prop_assert!(bend.is_nan()),
            (RayOutcome::Escapes(one), RayOutcome::Escapes(both)) => {
                let allowed = 4e-15 * one.abs().max(1.0);
                prop_assert!((bend - one).abs() <= allowed, "{:?}: {} {}", at, bend, one);
                prop_assert!((bending.bend - both.bend).abs() <= allowed, "{:?}", at);
                // The slope of the residual is a quotient of small numbers straight away.
                let rounding = 1e-12 + 1e-15 / at.x.sqrt().max(1e-9);
                let off = (bending.slope - both.slope).abs();
                // At the last number beside the edge the slope is infinite.
                prop_assert!(
                    bending.slope == both.slope || off <= rounding * both.slope.abs().max(1.0),
                    "{:?}: {:?} {:?}",
                    at,
                    bending,
                    both
                );
            }
            outcomes => prop_assert!(false, "{:?}: {:?}", at, outcomes),
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn many_rays_bend_as_each_of_them(
        observer in observers(),
        at in prop::collection::vec(coordinates(), 0..40),
    ) {
        compare(&default_atlas().row(observer).unwrap(), &at)?;
    }

    #[test]
    fn a_row_of_any_length_and_interpolation_is_looked_up(
        observer in observers(),
        texels in 4..600u32,
        linear in any::<bool>(),
        at in prop::collection::vec(coordinates(), 1..20),
    ) {
        let interpolation = if linear { Interpolation::Linear } else { Interpolation::Hermite };
        let row = default_atlas().row(observer).unwrap().resampled(texels, interpolation).unwrap();
        for (at, bend) in at.iter().zip(row.bend_many(&at)) {
            match row.bend(*at) {
                RayOutcome::Escapes(one) if !one.is_nan() => {
                    prop_assert!((bend - one).abs() <= 4e-14 * one.abs().max(1.0), "{:?}: {} {}", at, bend, one);
                }
                _ => prop_assert!(bend.is_nan()),
            }
        }
    }

    #[test]
    fn single_precision_is_as_good_as_it_says(
        observer in observers(),
        rays in prop::collection::vec((-6.0..0.0f64).prop_map(|log| 10f64.powf(log) as f32), 0..80),
    ) {
        let row = default_atlas().row(observer).unwrap();
        let bends = row.bend_many_f32(&rays);
        prop_assert_eq!(bends.len(), rays.len());
        for (d, bend) in rays.into_iter().map(f64::from).zip(bends) {
            let at = ShadowCoordinate { x: 1.0 - d, one_minus_x: d };
            let exact = row.bend(at).escaped().unwrap();
            let allowed = if observer.is_inside() { 2e-6 } else { 8e-7 };
            prop_assert!((f64::from(bend) - exact).abs() < allowed, "{:e}: {} {}", d, bend, exact);
        }
    }
}

#[test]
fn captured_rays_and_numbers_that_are_none_stay_so_in_single_precision() {
    let row = default_atlas().row(Observer::at(3.0).unwrap()).unwrap();
    let rays = [0.0, -0.0, -1.0, f32::NEG_INFINITY, f32::NAN, 1e-45, 1.0];
    let bends = row.bend_many_f32(&rays);
    let nan: Vec<bool> = bends.iter().map(|bend| bend.is_nan()).collect();
    assert_eq!(nan, [true, true, true, true, true, false, false]);
    let at = |one_minus_x: f64| ShadowCoordinate {
        x: 1.0 - one_minus_x,
        one_minus_x,
    };
    let exact = row.bend(at(f64::from(rays[5]))).escaped().unwrap();
    assert!((f64::from(bends[5]) / exact - 1.0).abs() < 1e-7);
}

/// At q = 1 the lookup is at the end of the last interval, also where the number of intervals is even.
#[test]
fn straight_away_is_the_end_of_the_last_interval() {
    let at = ShadowCoordinate {
        x: 0.0,
        one_minus_x: 1.0,
    };
    for texels in [63, 64, 253] {
        let row = default_atlas()
            .row(Observer::falling(30.0).unwrap())
            .unwrap();
        let row = row.resampled(texels, Interpolation::Hermite).unwrap();
        let one = row.bend(at).escaped().unwrap();
        assert!((row.bend_many(&[at])[0] - one).abs() < 1e-15, "{texels}");
        assert!(
            (f64::from(row.bend_many_f32(&[1.0])[0]) - one).abs() < 1e-7,
            "{texels}"
        );
    }
}

#[test]
fn what_is_longer_is_left_alone() {
    let row = default_atlas().row(Observer::at_infinity()).unwrap();
    let at: Vec<_> = (1..=11)
        .map(|i| ShadowCoordinate::from_b(2.5 + 0.3 * f64::from(i)))
        .collect();
    let mut bends = [-1.0; 13];
    row.batch().bend(&at, &mut bends);
    assert!(bends[..11].iter().all(|&bend| bend > 0.0) && bends[11..] == [-1.0; 2]);
    let mut few = [-1.0; 3];
    row.batch().bend(&at, &mut few);
    assert_eq!(few, bends[..3]);
    assert!(row.bend_many(&[]).is_empty() && row.bend_many_f32(&[]).is_empty());
}

#[cfg(feature = "baking")]
#[test]
fn rows_on_other_axes_are_looked_up_one_by_one() {
    use crate::baking::{Recipe, bake};
    let recipe = Recipe {
        axis: Axis::UniformInverseB {
            b_min: 2.7,
            b_max: 100.0,
        },
        rows: crate::Rows::One {
            inverse_radius: 0.0,
        },
        ..Recipe::default()
    };
    let row = bake(&recipe, || ())
        .unwrap()
        .row(Observer::at_infinity())
        .unwrap();
    let at = [2.0, 2.7, 5.0, B_CRIT * 20.0].map(ShadowCoordinate::from_b);
    let bends = row.bend_many(&at);
    let single = row.bend_many_f32(&at.map(|at| at.one_minus_x as f32));
    for ((at, bend), single) in at.into_iter().zip(bends).zip(single) {
        match row.bend(at) {
            RayOutcome::Captured => assert!(bend.is_nan() && single.is_nan()),
            RayOutcome::Escapes(one) => {
                assert_eq!(bend, one);
                assert!((f64::from(single) - one).abs() < 1e-5);
            }
        }
    }
}
