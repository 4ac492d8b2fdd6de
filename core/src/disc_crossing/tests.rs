use super::*;
use crate::rk4::{Event, Stepper, march};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// The ray that `observer` sees at `at` and `azimuth`.
fn traced(
    disc: &ThinDisc,
    observer: &Observer,
    at: ShadowCoordinate,
    azimuth: f64,
) -> (Ray, TracedRay) {
    let traced = TracedRay::in_closed_form(disc, observer, at, azimuth);
    (observer.ray_at(at), traced)
}

/// The crossings of the ray from infinity with the impact parameter `b`.
fn from_infinity(disc: &ThinDisc, b: f64, azimuth: f64) -> Vec<Crossing> {
    let (_, ray) = traced(
        disc,
        &Observer::at_infinity(),
        ShadowCoordinate::from_b(b),
        azimuth,
    );
    disc.crossings(&ray).collect()
}

fn disc(inclination_deg: f64) -> ThinDisc {
    ThinDisc::new(3.0, 1e6, inclination_deg, 0.0).unwrap()
}

/// Impact parameters of the images of a disc inclined by 80°, for an observer far away, in units of M = r_s/2: of the near
/// point, the side and the far point, and of the second image at the side; computed independently of this project.
const IMAGES: [(f64, [f64; 3], f64); 3] = [
    (6.0, [1.043_217, 6.932_148, 6.669_365], 5.478_914),
    (10.0, [1.737_810, 10.956_115, 8.407_115], 5.666_150),
    (20.0, [3.474_292, 20.976_651, 11.892_317], 5.865_411),
];

#[test]
fn the_images_are_where_they_are_known_to_be() {
    let disc = disc(80.0);
    for (r, [near, side, far], second) in IMAGES {
        for (b, azimuth, order) in [
            (near, -FRAC_PI_2, 0),
            (side, 0.0, 0),
            (far, FRAC_PI_2, 0),
            (second, 0.0, 1),
            (second, PI, 1),
        ] {
            // The radius grows with b. Below 6 M the disc has ended.
            let radius = |b: f64| {
                let found = from_infinity(&disc, 0.5 * b, azimuth);
                found
                    .iter()
                    .find(|c| c.order == order)
                    .map_or(6.0, |c| 2.0 * c.radius)
            };
            let (below, above) = (radius(b - 1e-6), radius(b + 1e-6));
            assert!(below <= r && r < above, "{r} M, b = {b} M: {below} {above}");
        }
    }
}

#[test]
fn face_on_the_shift_is_that_of_time_and_the_innermost_orbit_has_root_half() {
    let (b, azimuth) = (4.0, 0.3);
    let image = from_infinity(&disc(0.0), b, azimuth)[0];
    assert!((image.phi - FRAC_PI_2).abs() < 1e-15);
    assert!((image.shift - (1.0 - 1.5 / image.radius).sqrt()).abs() < 1e-14);
    // The image of the innermost orbit: the radius at a quarter of a turn.
    let (mut low, mut high) = (3.0, b);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match from_infinity(&disc(0.0), middle, azimuth).first() {
            Some(_) => high = middle,
            None => low = middle,
        }
    }
    let innermost = from_infinity(&disc(0.0), high, azimuth)[0];
    assert!((innermost.radius - 3.0).abs() < 1e-12);
    assert!((innermost.shift - 0.5f64.sqrt()).abs() < 1e-12);
}

#[test]
fn along_and_against_the_motion_of_the_innermost_orbit_the_shifts_are_known() {
    // A ray whose periapsis is at r = 3, in a plane almost that of the disc, which it crosses there.
    let b = 3.0 / (1.0 - 1.0 / 3f64).sqrt() * (1.0 + 1e-12);
    let tilt = 1e-6_f64;
    for (azimuth, known) in [(PI - tilt, 2f64.sqrt()), (tilt, 2f64.sqrt() / 3.0)] {
        let at = ShadowCoordinate::from_b(b);
        let (_, ray) = traced(&disc(90.0), &Observer::at_infinity(), at, azimuth);
        let periapsis = 0.5 * ray.phi_infinity.unwrap();
        let inclination = FRAC_PI_2 + (tilt.sin() * periapsis.tan()).atan();
        let found: Vec<_> = disc(inclination.to_degrees()).crossings(&ray).collect();
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].radius - 3.0).abs() < 1e-9, "{found:?}");
        assert!((found[0].shift - known).abs() < 1e-9, "{found:?}");
    }
}

#[test]
fn an_observer_in_the_plane_is_at_no_crossing_and_a_ray_in_the_plane_has_none() {
    let edge_on = disc(90.0);
    for observer in [5.0, 50.0].map(|r| Observer::at(r).unwrap()) {
        let at = observer.shadow_coordinate(0.9);
        for azimuth in [0.0, PI] {
            // sin π is not 0 in floating point.
            let (_, ray) = traced(&edge_on, &observer, at, azimuth);
            let few: Vec<_> = edge_on.crossings(&ray).collect();
            assert!(few.iter().all(|c| c.phi == PI), "{few:?}");
        }
        let (_, within) = traced(&edge_on, &observer, at, 0.0);
        assert_eq!(edge_on.crossings(&within).count(), 0);
        // The far side appears above and below the hole, as the direct image.
        let at = observer.shadow_coordinate(1.3 * observer.shadow_angle());
        for azimuth in [0.7, -0.7] {
            let (_, ray) = traced(&edge_on, &observer, at, azimuth);
            let found: Vec<_> = edge_on.crossings(&ray).collect();
            assert!(
                matches!(
                    found[..],
                    [Crossing {
                        phi: PI,
                        order: 0,
                        ..
                    }]
                ),
                "{found:?}"
            );
        }
    }
}

#[test]
fn straight_at_the_hole_and_straight_away_there_is_no_crossing() {
    for r in [1.2, 2.0, 5.0, 1e4] {
        let observer = Observer::at(r).unwrap();
        for inclination in [0.0, 60.0, 90.0] {
            for theta in [0.0, 1e-300, 1e-12, PI] {
                let at = observer.shadow_coordinate(theta);
                let (_, ray) = traced(&disc(inclination), &observer, at, 0.4);
                assert_eq!(disc(inclination).crossings(&ray).count(), 0, "{r} {theta}");
            }
        }
    }
}

/// Observers at rest far away, within the radii of the disc, and inside it down to the photon sphere and below.
fn observers() -> impl Strategy<Value = Observer> {
    prop_oneof![
        Just(Observer::at_infinity()),
        (0.3..18.0f64).prop_map(|n| Observer::at(3.0 + 10f64.powf(n - 6.0)).unwrap()),
        (3.0..12.0f64).prop_map(|r| Observer::at(r).unwrap()),
        (1.05..3.0f64).prop_map(|r| Observer::at(r).unwrap()),
    ]
}

/// Directions, crowded at the shadow's edge on both sides, straight at the hole, and straight away from it.
fn directions() -> impl Strategy<Value = ShadowCoordinate> {
    let gap = |n: f64, sign: f64| ShadowCoordinate {
        x: 1.0 - sign * 10f64.powf(-n),
        one_minus_x: sign * 10f64.powf(-n),
    };
    let of = |x: f64| ShadowCoordinate {
        x,
        one_minus_x: 1.0 - x,
    };
    prop_oneof![
        (0.0..1.0f64).prop_map(of),
        (0.05..9.0f64).prop_map(move |n| gap(n, 1.0)),
        (0.05..9.0f64).prop_map(move |n| gap(n, -1.0)),
        (0.0..12.0f64).prop_map(move |n| of(10f64.powf(-n))),
        (0.0..12.0f64).prop_map(move |n| of(10f64.powf(n))),
    ]
}

/// Inclinations, degrees, crowded at face-on and edge-on.
fn inclinations() -> impl Strategy<Value = f64> {
    prop_oneof![
        0.0..180.0f64,
        Just(0.0),
        Just(90.0),
        (1.0..12.0f64).prop_map(|n| 90.0 + 10f64.powf(-n)),
        (1.0..12.0f64).prop_map(|n| 90.0 - 10f64.powf(-n)),
        (1.0..12.0f64).prop_map(|n| 10f64.powf(-n)),
    ]
}

/// u at the orbital angle `phi` from the observer, by RK4.
fn integrated(ray: &Ray, phi: f64) -> f64 {
    let binet = |y: &[f64; 3]| [1.0, y[2], 1.5 * y[1] * y[1] - y[1]];
    let there = Event {
        index: 0,
        value: phi,
    };
    let start = [0.0, ray.u, ray.du_dphi];
    march(&binet, start, there, Stepper::Adaptive(1e-12))
        .unwrap()
        .state[1]
}

/// The factor by which an error of the initial conditions grows along a ray that goes round the photon sphere by `phi`.
fn growth(phi: f64) -> f64 {
    phi.exp()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8000))]

    /// Three ways to the radius: the closed form of the crossing, the inverse of it by Carlson's integral, and RK4 from the
    /// observer.
    #[test]
    fn three_ways_give_the_same_radius(
        observer in observers(), at in directions(), inclination in inclinations(), azimuth in -PI..PI,
    ) {
        let disc = ThinDisc::new(3.0, 100.0, inclination, 0.0).unwrap();
        let (ray, traced) = traced(&disc, &observer, at, azimuth);
        let found: Vec<_> = disc.crossings(&traced).collect();
        prop_assert!(found.is_sorted_by(|a, b| a.phi < b.phi), "{found:?}");
        for crossing in found {
            let u = 1.0 / crossing.radius;
            let allowed = 1e-10 * growth(crossing.phi);
            let by_rk4 = integrated(&ray, crossing.phi);
            prop_assert!((by_rk4 - u).abs() < allowed * u.max(0.01), "{crossing:?} {by_rk4} {u}");
            let phase = orbit::phase(ray.inv_b, u);
            let inward = traced.observer_phase.map(|start| crossing.phi + start);
            let outward = traced.phi_infinity.map(|end| end - crossing.phi);
            let off = |phase: f64| {
                let off = |leg: Option<f64>| leg.map_or(f64::INFINITY, |leg| (leg - phase).abs());
                off(inward).min(off(outward))
            };
            // At the periapsis the radius does not change with the phase, and the phase has the root of its error.
            let slope = orbit::slope(ray.inv_b, u).unwrap_or(0.0);
            if slope > 1e-3 * u {
                let off = off(phase.unwrap());
                prop_assert!(off < allowed.max(1e-9), "{crossing:?} {off}");
            }
        }
    }

    /// What is drawn is in the disc, on the side of the plane where the image order says, and has a shift.
    #[test]
    fn crossings_lie_in_the_plane_and_within_the_radii(
        observer in observers(), at in directions(), inclination in inclinations(), azimuth in -PI..PI, node in -180.0..180.0f64,
    ) {
        let disc = ThinDisc::new(3.0, 12.0, inclination, node).unwrap();
        let (_, traced) = traced(&disc, &observer, at, azimuth);
        let [x, y, z] = disc.axis();
        for Crossing { phi, radius, order, shift } in disc.crossings(&traced) {
            let height = z * phi.cos() + (x * azimuth.cos() + y * azimuth.sin()) * phi.sin();
            prop_assert!(height.abs() < 1e-14 * (1.0 + phi), "{height}");
            prop_assert!((3.0..=12.0).contains(&radius));
            prop_assert!(phi > 0.0 && (phi / PI).ceil() == f64::from(order) + 1.0, "{phi} {order}");
            prop_assert!(shift > 0.0 && shift.is_finite(), "{shift}");
        }
    }

    /// The crossings are all that RK4 finds: the height above the plane changes its sign within the radii nowhere else.
    #[test]
    fn no_crossing_is_missed(
        observer in observers(), at in directions(), inclination in inclinations(), azimuth in -PI..PI,
    ) {
        let disc = ThinDisc::new(3.0, 12.0, inclination, 0.0).unwrap();
        let (ray, traced) = traced(&disc, &observer, at, azimuth);
        let found: Vec<_> = disc.crossings(&traced).map(|c| c.phi).collect();
        let Some(first) = disc.first_angle(&traced) else {
            prop_assert!(found.is_empty());
            return Ok(());
        };
        if ray.inv_b > 100.0 {
            return Ok(());
        }
        // A ray that leaves the disc's radii outwards does not come back.
        let end = traced.phi_infinity.unwrap_or(PI);
        let mut count = 0;
        for phi in (0..9).map(|k| first + f64::from(k) * PI).take_while(|phi| *phi < end - 1e-9) {
            let u = if phi < 1e-9 { ray.u } else { integrated_until(&ray, phi) };
            let margin = 1e-8 * growth(phi);
            if u > 1.0 / 12.0 + margin && u < 1.0 / 3.0 - margin {
                prop_assert!(found.iter().any(|f| (f - phi).abs() < 1e-9), "{phi} {u} not in {found:?}");
                count += 1;
            }
        }
        prop_assert!(count <= 2);
    }
}

/// As [`integrated`], but ∞ if the ray falls through the horizon before.
fn integrated_until(ray: &Ray, phi: f64) -> f64 {
    let binet = |y: &[f64; 3]| [1.0, y[2], 1.5 * y[1] * y[1] - y[1]];
    let mut y = [0.0, ray.u, ray.du_dphi];
    let steps = (phi * (1.0 + ray.inv_b) / 0.002).ceil();
    for _ in 0..steps as u32 {
        y = crate::rk4::step(&binet, &y, phi / steps);
        if y[1].is_nan() || y[1] > 1.5 {
            return f64::INFINITY;
        }
    }
    y[1]
}
