//! The deflection angle in closed form: the reference that the RK4 integration in [`crate::direct`] is checked
//! against.
//!
//! φ = ∫ du / √(u³ − u² + 1/b²) is an elliptic integral of the first kind. It is reduced to Carlson's R_F (crate
//! `ellip`). The roots of the cubic and all their differences are written so that nothing cancels: not near the
//! critical impact parameter, not in weak fields, not at the photon sphere.

use crate::{Path, Ray, RayOutcome};

/// The bending Δ of `ray` in rad, accurate to about 1e-14 + ε/(1−x), where ε is the rounding error of the initial
/// conditions.
///
/// ```
/// use lensbake_core::{Ray, exact};
///
/// // Light that passes the Sun at grazing incidence: b = 235,600 Schwarzschild radii, 1.75 arc seconds.
/// let bend = exact::bend(&Ray::from_infinity(235_600.0).unwrap()).escaped().unwrap();
/// assert!((bend.to_degrees() * 3600.0 - 1.751).abs() < 1e-3);
/// ```
pub fn bend(ray: &Ray) -> RayOutcome {
    match ray.path() {
        Path::Radial => RayOutcome::Escapes(0.0),
        _ => phi_infinity(ray).map(|phi| ray.bend_from_phi(phi)),
    }
}

/// φ_∞, the orbital angle of `ray` between the observer and infinity, rad, as accurate as [`bend`]. The error of a small
/// angle, near straight away from the hole, is as small relative to it.
pub fn phi_infinity(ray: &Ray) -> RayOutcome {
    RayOutcome::Escapes(match ray.path() {
        Path::Captured => return RayOutcome::Captured,
        Path::Radial => std::f64::consts::PI - ray.theta,
        Path::ViaPeriapsis => {
            let to_infinity = phi_from_apsis(ray, 0.0, ray.u_apsis());
            to_infinity + phi_from_apsis(ray, ray.u, depth_below_apsis(ray))
        }
        Path::OverPhotonSphere | Path::Outward => phi_outward(ray),
    })
}

/// u_a − u at the observer, from (du/dφ)² = (u − u₁)(u₂ − u)(u₃ − u) instead of by subtraction.
fn depth_below_apsis(ray: &Ray) -> f64 {
    if ray.u == 0.0 {
        return ray.u_apsis();
    }
    let (u1, _) = ray.negative_root();
    let c = ray.du_dphi.powi(2) / (ray.u - u1);
    let gap = ray.positive_root_gap();
    2.0 * c / (gap + (gap * gap + 4.0 * c).sqrt())
}

/// Orbital angle between the periapsis u_a and `u` = u_a − `depth`, by Carlson's integral with three real factors
/// and one limit at a root (DLMF 19.29.4).
fn phi_from_apsis(ray: &Ray, u: f64, depth: f64) -> f64 {
    let (u1, _) = ray.negative_root();
    let gap = ray.positive_root_gap();
    let span = ray.apsis_above_negative_root();
    let (above_u3, below_u1) = (gap + depth, u - u1);
    2.0 * depth.sqrt() * r_f(above_u3 * span, gap * span, below_u1 * gap)
}

/// Orbital angle of an outward ray from the observer to infinity, by Carlson's integral with one linear and one
/// quadratic factor, which is valid for real and for complex pairs of roots (Carlson 1991, Math. Comp. 56, 267;
/// DLMF 19.29.28 with 19.29.7).
pub(crate) fn phi_outward(ray: &Ray) -> f64 {
    let u = ray.u;
    let (u1, v) = ray.negative_root();
    // Square roots of the linear factor u − u₁ and of the quadratic factor, at both ends.
    let (linear, linear_far) = ((u - u1).sqrt(), (-u1).sqrt());
    let quadratic = ray.du_dphi.abs() / linear;
    let quadratic_far = (u1 * (u1 - 1.0)).sqrt();
    // (ξ + η)² − u² = cross + lean. If lean is negative, the sum cancels; the equivalent quotient does not.
    let cross = 2.0 * quadratic * quadratic_far;
    // −2u₁ − u, computed from small quantities: u and u₁ far from the hole, w and v near the photon sphere.
    let small = if ray.w > 1.0 / 3.0 {
        -2.0 * u1 - u
    } else {
        2.0 * v + ray.w
    };
    let lean = (1.0 - u1) * small;
    let bracket = if lean >= 0.0 {
        cross + lean
    } else {
        3.0 * u * u * (1.0 - u1) * v / (cross - lean)
    };
    let m_sq = ((linear + linear_far) / u).powi(2) * bracket;
    let a = 1.0 - 3.0 * u1;
    let c = 2.0 * (u1 * (3.0 * u1 - 2.0)).sqrt();
    let l_plus_sq = m_sq + a + c;
    let l_minus_sq = m_sq - 3.0 * (1.0 - u1) * v / (a + c);
    4.0 * r_f(m_sq, l_minus_sq, l_plus_sq)
}

/// Carlson's R_F. NaN outside its domain, which no ray reaches.
fn r_f(x: f64, y: f64, z: f64) -> f64 {
    ellip::elliprf(x, y, z).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rk4::Stepper;
    use crate::{Observer, ShadowCoordinate, direct};
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// (b, Δφ) for rays from infinity, computed from the integral with 25 digits, independently of this project.
    const FROM_INFINITY: [(f64, f64); 9] = [
        // For the f64 nearest to 2.5981; for 2.5981 itself the value is 11.200 883 845 258 15.
        (2.5981, 11.200_883_845_254_955),
        (2.6, 6.810_371_956_663_497),
        (2.7, 2.919_396_339_609_557),
        (3.0, 1.719_388_310_230_169),
        (4.0, 0.858_730_018_079_095_3),
        (6.0, 0.452_605_412_598_886_4),
        (10.0, 0.236_135_995_388_469_9),
        (100.0, 0.020_299_966_239_537),
        (1000.0, 0.002_002_950_587_024_579),
    ];

    /// (r, θ in degrees, Δ) for static observers, computed in the same way.
    const STATIC: [(f64, f64, f64); 11] = [
        (25.0, 30.0, 0.166_853_965_779_262_6),
        (10.0, 30.0, 0.516_183_057_451_617),
        (10.0, 90.0, 0.110_938_052_169_452_3),
        (10.0, 150.0, 0.029_045_012_913_274_29),
        (5.0, 30.0, 2.257_327_007_180_627),
        (3.0, 60.0, 1.161_605_726_300_589),
        (2.0, 70.0, 2.766_866_113_759_298),
        (1.5, 91.0, 4.205_156_393_021_806),
        (1.5, 120.0, 1.007_019_464_772_651),
        (1.2, 150.0, 0.844_994_981_563_740_1),
        (1.05, 170.0, 0.646_782_515_739_128_5),
    ];

    fn rk4(ray: &Ray) -> f64 {
        direct::bend(ray, Stepper::Adaptive(1e-12))
            .escaped()
            .unwrap()
    }

    #[test]
    fn both_methods_give_the_known_values() {
        let far = FROM_INFINITY.map(|(b, bend)| (Ray::from_infinity(b).unwrap(), bend));
        let near = STATIC.map(|(r, deg, bend)| {
            (
                Observer::at(r).unwrap().ray(f64::to_radians(deg)).unwrap(),
                bend,
            )
        });
        for (ray, known) in far.into_iter().chain(near) {
            let closed = bend(&ray).escaped().unwrap();
            assert!(
                (closed - known).abs() < 1e-12,
                "closed form, {ray:?}: {closed}"
            );
            assert!((rk4(&ray) - known).abs() < 1e-11, "RK4, {ray:?}");
        }
    }

    #[test]
    fn the_orbital_angle_of_the_periapsis_at_b_3_is_known() {
        let bend = bend(&Ray::from_infinity(3.0).unwrap()).escaped().unwrap();
        assert!((0.5 * (bend + PI) - 2.430_490_481_909_981).abs() < 1e-14);
    }

    #[test]
    fn straight_into_the_hole_and_straight_away() {
        for r in [1.001, 1.5, 3.0, 1e6] {
            let observer = Observer::at(r).unwrap();
            assert_eq!(bend(&observer.ray(0.0).unwrap()), RayOutcome::Captured);
            let away = bend(&observer.ray(PI).unwrap()).escaped().unwrap();
            assert!(away.abs() < 1e-12, "r {r}: {away:e}");
        }
    }

    /// Small distances 10⁻ⁿ with n uniform, so that every decade is equally likely.
    fn decades(n: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
        n.prop_map(|n| 10f64.powf(-n))
    }

    /// χ over all radii, concentrated near r = ∞, the photon sphere and the horizon.
    fn radii() -> impl Strategy<Value = f64> {
        let photon_sphere = (2.0 / 3.0_f64).sqrt().asin();
        prop_oneof![
            0.0..FRAC_PI_2,
            decades(1.0..12.0),
            decades(1.0..12.0).prop_map(move |d| photon_sphere + d),
            decades(1.0..12.0).prop_map(move |d| photon_sphere - d),
            decades(1.0..6.0).prop_map(|d| FRAC_PI_2 - d),
            Just(photon_sphere),
            Just(FRAC_PI_2),
            Just(0.0),
        ]
    }

    /// Normalised shadow coordinates, concentrated near the shadow boundary down to 1 − x = 1e-12, and near x = 0,
    /// straight away from the hole.
    fn sights() -> impl Strategy<Value = ShadowCoordinate> {
        prop_oneof![
            (0.001..0.999).prop_map(ShadowCoordinate::from_s),
            decades(0.1..6.0).prop_map(ShadowCoordinate::from_s),
            decades(0.1..12.0).prop_map(|x| ShadowCoordinate {
                x,
                one_minus_x: 1.0 - x
            }),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn integration_agrees_with_the_closed_form(chi in radii(), at in sights()) {
            let ray = Observer::at_chi(chi).ray_at(at);
            let closed = bend(&ray).escaped().unwrap();
            prop_assert!((closed - rk4(&ray)).abs() < 1e-10, "{closed} against {}", rk4(&ray));
        }

        #[test]
        fn integration_agrees_for_the_falling_observer(
            r in prop_oneof![
                decades(0.0..2.0),
                decades(1.0..9.0).prop_map(|d| 1.0 + d),
                decades(1.0..9.0).prop_map(|d| 1.0 - d),
                decades(1.0..9.0).prop_map(|d| 1.5 + d),
                1.0..30.0,
            ],
            at in sights(),
        ) {
            let ray = Observer::falling(r).unwrap().ray_at(at);
            let closed = bend(&ray).escaped().unwrap();
            prop_assert!((closed - rk4(&ray)).abs() < 1e-10, "{closed} against {}", rk4(&ray));
        }

        #[test]
        fn a_view_angle_gives_the_same_ray_as_its_shadow_coordinate(
            r in 1.001..100.0, theta in 0.01..3.13,
        ) {
            let observer = Observer::at(r).unwrap();
            let at = observer.shadow_coordinate(theta);
            prop_assert!((observer.view_angle(at.x) - theta).abs() < 1e-14);
            prop_assert!((at.x + at.one_minus_x - 1.0).abs() < 1e-14 * (1.0 + at.x));
            let b = r * theta.sin() / (1.0 - 1.0 / r).sqrt();
            let ray = observer.ray(theta).unwrap();
            prop_assert!((ray.impact_parameter() / b - 1.0).abs() < 1e-12);
        }

        #[test]
        fn bending_grows_towards_the_edge(chi in radii(), s in 0.001..0.99) {
            let observer = Observer::at_chi(chi);
            let bend = |s| bend(&observer.ray_at(ShadowCoordinate::from_s(s))).escaped().unwrap();
            prop_assert!(bend(s) > bend(s * 1.01));
        }
    }
}
