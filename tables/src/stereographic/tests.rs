use super::arcs::distance;
use super::*;
use crate::default_atlas;
use lensbake_core::{BendAndSlope, Observer, ShadowCoordinate};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// Observers at rest and in free fall, above the horizon and below.
fn observers() -> impl Iterator<Item = Observer> {
    let at_rest = [1.0001, 1.01, 1.2, 1.5, 2.0, 3.0, 5.0, 25.0, 1000.0, 1e6];
    let falling = [1000.0, 10.0, 3.0, 1.5, 1.01, 1.0, 0.9, 0.5, 0.1, 0.03, 0.01];
    let at_rest = at_rest.map(|r| Observer::at(r).unwrap());
    let falling = falling.map(|r| Observer::falling(r).unwrap());
    at_rest.into_iter().chain(falling)
}

fn row(observer: Observer) -> Row {
    default_atlas().row(observer).unwrap()
}

/// The angle between two directions in a plane, rad.
fn between(angle: f64, other: f64) -> f64 {
    let turns = (angle - other) / TAU;
    TAU * (turns - turns.round()).abs()
}

/// An end of the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    /// X = 0, straight away from the hole.
    Away,
    /// X = 1, the shadow's edge.
    Edge,
}

/// θ′ of the texels, computed in f64, and of the row at the distance v from an end of the axis, rad.
fn sky_angles(row: &Row, texels: &[[f32; 4]], end: End, v: f64) -> [f64; 2] {
    let (axis, observer) = (row.axis(), row.observer());
    let k = (0..INTERVALS)
        .rfind(|&k| distance(k) <= v)
        .unwrap_or_default();
    let t = if k == 0 { v } else { v - distance(k) };
    let (first, x, one_minus_x) = match end {
        End::Away => (0, v, 1.0 - v),
        End::Edge => (INTERVALS, 1.0 - v, v),
    };
    let [a, b, slope_a, slope_b] = texels[first + k].map(f64::from);
    let found = 2.0 * (b + t * slope_b).atan2(a + t * slope_a);
    let at = axis.shadow_coordinate_at(observer, ShadowCoordinate { x, one_minus_x });
    let bend = row.bend(at).escaped().unwrap();
    // The view angle by the edge in f32, as the lookup has it.
    let edge = ShadowEdge::of(observer);
    let [tan_half, scale] = [edge.tan_half, edge.scale].map(f64::from);
    let seen = 2.0 * (tan_half * (scale * x + one_minus_x)).atan2(x);
    [found, seen - bend]
}

#[test]
fn the_directions_are_those_of_the_row() {
    for observer in observers() {
        let row = row(observer);
        let texels = StereographicRow::new(&row).texels;
        for end in [End::Away, End::Edge] {
            for i in 0..40_000 {
                // Uniform in ln v.
                let v = f64::exp2(-24.0 + 23.0 * f64::from(i) / 40_000.0);
                let [found, exact] = sky_angles(&row, &texels, end, v);
                let off = between(found, exact);
                assert!(
                    off < 1.3e-7,
                    "r {}, {end:?} {v}: {off:e}",
                    observer.radius()
                );
            }
        }
    }
}

#[test]
fn motion_along_the_radius_changes_the_edge_alone() {
    // Farther away, the row of a falling observer is less accurate.
    for r in [1.01, 1.5, 3.0, 10.0] {
        let [rest, fall] = [Observer::at(r), Observer::falling(r)].map(|observer| {
            let row = row(observer.unwrap());
            StereographicRow::new(&row)
        });
        assert!((rest.edge.tan_half - fall.edge.tan_half).abs() > 1e-5);
        for (rest, fall) in rest.texels.iter().zip(&fall.texels) {
            let [rest, fall] =
                [rest, fall].map(|[a, b, ..]| 2.0 * f64::from(*b).atan2((*a).into()));
            assert!(between(rest, fall) < 3e-7, "r {r}");
        }
    }
}

#[test]
fn without_bending_the_lookup_is_exact() {
    // So far away, these rays are hardly bent.
    let row = row(Observer::at(1e6).unwrap());
    let stereographic = StereographicRow::new(&row);
    for i in 100..1000 {
        let theta = PI * f64::from(i) / 1000.0;
        let (c, p) = (theta.cos() as f32, theta.sin() as f32);
        let sky = stereographic.sky_direction(c, p).escaped().unwrap();
        let [cos, sin] = sky.cos_sin.map(f64::from);
        let seen = f64::from(p).atan2(c.into());
        // The deflection angle is at most 2/b.
        let bound = 2e-6 / theta.sin().max(theta) + 3e-7;
        assert!(between(sin.atan2(cos), seen) < bound, "{theta}");
        assert!((sky.radial - 1.0).abs() < 3e-5, "{theta}: {}", sky.radial);
    }
}

#[test]
fn straight_away_the_derivative_has_its_limit() {
    for observer in observers() {
        let row = row(observer);
        let stereographic = StereographicRow::new(&row);
        let radial = |p: f32| {
            let sky = stereographic.sky_direction(-1.0, p).escaped().unwrap();
            assert!(sky.cos_sin[0] < 0.0);
            sky.radial
        };
        let limit = radial(1e-3);
        assert!(limit > 0.0);
        for p in [0.0, 1e-20, 1e-7, 1e-5] {
            let off = radial(p) / limit - 1.0;
            assert!(off.abs() < 2e-3, "r {}, {p}: {off:e}", observer.radius());
            // Around the axis as along it.
            if p > 0.0 {
                let sky = stereographic.sky_direction(-1.0, p).escaped().unwrap();
                let [cos, sin] = sky.cos_sin;
                let off = sin / cos.hypot(sin) / p / limit - 1.0;
                assert!(off.abs() < 2e-3, "r {}, {p}: {off:e}", observer.radius());
            }
        }
    }
}

/// Where the two halves of the axis meet: among these directions are some with exactly X = 1/2 in f32.
#[test]
fn the_halves_of_the_axis_meet() {
    let mut in_the_middle = 0;
    for observer in observers() {
        let row = row(observer);
        let stereographic = StereographicRow::new(&row);
        let middle = ShadowCoordinate {
            x: 0.5,
            one_minus_x: 0.5,
        };
        let at = row.axis().shadow_coordinate_at(&observer, middle);
        for k in -500..=500 {
            let theta = observer.view_angle(at.x) * (1.0 + 1e-8 * f64::from(k));
            let (c, p) = (theta.cos() as f32, theta.sin() as f32);
            let seen = f64::from(p).atan2(c.into());
            let x = row_coordinate(c, p, stereographic.edge, stereographic.side);
            in_the_middle += usize::from(x == 0.5);
            let bend = row
                .bend(observer.shadow_coordinate(seen))
                .escaped()
                .unwrap();
            let sky = stereographic.sky_direction(c, p).escaped().unwrap();
            let [cos, sin] = sky.cos_sin.map(f64::from);
            let rounding = 1e-6 * f64::from(stereographic.edge.scale);
            let off = between(sin.atan2(cos), seen - bend);
            assert!(
                off < 3e-7 + rounding,
                "r {}, X {x}: {off:e}",
                observer.radius()
            );
        }
    }
    assert!(in_the_middle > 50, "{in_the_middle}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// In f32 as on a GPU, at all directions outside the shadow, crowding at its edge and straight away.
    #[test]
    fn the_lookup_in_single_precision_is_as_good_as_its_input(
        which in 0..21_usize,
        exponent in -6.0..0.0,
        from_edge in any::<bool>(),
        size in 0.1..10.0_f64,
    ) {
        let observer = observers().nth(which).unwrap();
        let row = row(observer);
        let edge = observer.shadow_angle();
        let part = f64::powf(10.0, exponent);
        let theta = if from_edge { edge + part * (PI - edge) } else { PI - part * (PI - edge) };
        let (c, p) = (theta.cos() as f32, theta.sin().max(0.0) as f32);
        let seen = f64::from(p).atan2(c.into());
        let at = observer.shadow_coordinate(seen);
        let stereographic = StereographicRow::new(&row);
        // One rounding of 1 − X turns the direction by about ε/(1−X).
        let near = row.axis().row_coordinate(&observer, at).one_minus_x.abs();
        let edge = stereographic.edge;
        // Below the horizon the weight of the logarithm grows, and X is a quotient of differences.
        let weight = f64::from(edge.scale * edge.log_weight.abs().max(1.0));
        let rounding = 1e-6 * weight / near;
        prop_assume!(rounding < 1e-2);
        let BendAndSlope { bend, slope } = row.bend_and_slope(at).escaped().unwrap();
        let sky = stereographic.sky_direction(c, p).escaped().unwrap();
        let [cos, sin] = sky.cos_sin.map(f64::from);
        let off = between(sin.atan2(cos), seen - bend);
        prop_assert!(off < 3e-7 + rounding, "r {}, {theta}: {off:e}", observer.radius());
        let radial = 1.0 - slope / observer.view_angle_slope(at.x);
        let off = f64::from(sky.radial) / radial - 1.0;
        // Straight away from the hole the row's own derivative is a quotient of small numbers.
        let cancelled = f64::min(1e-8 / at.x, 1e-3);
        prop_assert!(off.abs() < 3e-4 + cancelled + 30.0 * rounding, "r {}, {theta}: dθ′/dθ {radial}, {off:e}", observer.radius());
        // The direction does not depend on the length of the vector.
        let longer = stereographic.sky_direction(c * size as f32, p * size as f32).escaped().unwrap();
        let [cos, sin] = longer.cos_sin.map(f64::from);
        prop_assert!(between(sin.atan2(cos), seen - bend) < 5e-7 + rounding);
    }
}

#[test]
fn the_texture_holds_the_texels() {
    let stereographic = StereographicRow::new(&row(Observer::at(10.0).unwrap()));
    let [width, height] = StereographicRow::TEXTURE_SIZE;
    let bytes = stereographic.texture_bytes();
    assert_eq!(bytes.len(), BYTES);
    assert_eq!((width * height) as usize * size_of::<[f32; 4]>(), BYTES);
    // WebGL 2 has no larger textures for sure.
    assert!(width <= 2048 && height <= 2048);
}
