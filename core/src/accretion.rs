//! Matter on circular orbits in a thin disc: the frequency at which it emits, and the light that it emits.

use crate::geodesic::{orbit_rate, orbit_time_dilation};

/// Radius of the innermost stable circular orbit, in units of r_s: the inner edge of a thin disc.
pub const INNERMOST_STABLE: f64 = 3.0;

/// The radius at which [`flux`] is greatest, in units of r_s.
pub const BRIGHTEST_RADIUS: f64 = 4.775_464_038_970_4;

/// ν_em/ν_∞, the frequency at which matter on the circular orbit at `r` > 3/2 emits light, divided by the frequency at
/// infinity: dt/dτ (1 − Ω L), with Ω the angular velocity in coordinate time. `angular_momentum` L is that of the light
/// about the axis of the orbit divided by its energy, in units of r_s: b times the cosine of the angle between the axes
/// of the two orbits. NaN for r ≤ 3/2, where there is no circular orbit.
///
/// ```
/// use lensbake_core::accretion::emitted_frequency;
///
/// // Light of the innermost stable orbit that leaves along the axis.
/// assert!((1.0 / emitted_frequency(3.0, 0.0) - 1.0 / 2f64.sqrt()).abs() < 1e-15);
/// ```
pub fn emitted_frequency(r: f64, angular_momentum: f64) -> f64 {
    match (orbit_time_dilation(r), orbit_rate(r)) {
        // The angular velocity in proper time is Ω dt/dτ.
        (Ok(dilation), Ok(rate)) => dilation - rate * angular_momentum,
        _ => f64::NAN,
    }
}

/// The energy per area and proper time that one face of a thin disc emits at radius `r`, in units of its greatest value
/// (Page and Thorne 1974, ApJ 191, 499, for a hole without spin): 1 at [`BRIGHTEST_RADIUS`], 0 at
/// [`INNERMOST_STABLE`] and inside, ∝ r⁻³ far away. The temperature goes as its fourth root.
pub fn flux(r: f64) -> f64 {
    page_thorne(r) / page_thorne(BRIGHTEST_RADIUS)
}

/// The flux of [`flux`] in units of 3Ṁ/(8πM²), with Ṁ the mass per time that the disc brings to the hole: with x = r/M = 2r,
///
/// ```text
/// (√x − √6 + (√3/2) ln(((√x+√3)(√6−√3)) / ((√x−√3)(√6+√3)))) / ((x − 3) x^{5/2})
/// ```
pub fn page_thorne(r: f64) -> f64 {
    if r <= INNERMOST_STABLE {
        return 0.0;
    }
    let x = 2.0 * r;
    let (root, root_3, root_6) = (x.sqrt(), 3f64.sqrt(), 6f64.sqrt());
    let inner = ((root + root_3) * (root_6 - root_3)) / ((root - root_3) * (root_6 + root_3));
    // The bracket is (x − 6)²/(…) near the inner edge, where its terms cancel.
    let bracket = root - root_6 + 0.5 * root_3 * inner.ln();
    bracket.max(0.0) / ((x - 3.0) * x * x * root)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn the_flux_is_greatest_where_it_is_known_to_be() {
        assert!((2.0 * BRIGHTEST_RADIUS - 9.550_928_077_9).abs() < 1e-9);
        let greatest = 3.0 / (8.0 * PI) * page_thorne(BRIGHTEST_RADIUS);
        assert!((greatest - 1.367_811e-5).abs() < 5e-12, "{greatest}");
        for r in [BRIGHTEST_RADIUS - 1e-3, BRIGHTEST_RADIUS + 1e-3] {
            assert!(flux(r) < 1.0 && flux(r) > 1.0 - 1e-5);
        }
        assert_eq!(flux(BRIGHTEST_RADIUS), 1.0);
        assert_eq!(flux(3.0), 0.0);
        assert_eq!(flux(2.0), 0.0);
    }

    /// ∫ 4πx F E dx = 1 − √(8/9): what matter loses on its way to the innermost stable orbit is what the disc emits.
    #[test]
    fn the_disc_emits_the_binding_energy() {
        // x = 6/t², dx = −12/t³ dt, by Simpson's rule.
        let integrand = |t: f64| {
            let x = 6.0 / (t * t);
            let energy = (1.0 - 2.0 / x) / (1.0 - 3.0 / x).sqrt();
            let flux = 3.0 / (8.0 * PI) * page_thorne(0.5 * x);
            4.0 * PI * x * flux * energy * 12.0 / (t * t * t)
        };
        let n = 4000;
        let h = 1.0 / f64::from(n);
        let weight = |i| if i % 2 == 1 { 4.0 } else { 2.0 };
        let inner: f64 = (1..n)
            .map(|i| weight(i) * integrand(f64::from(i) * h))
            .sum();
        // At t → 0 the integrand is finite: 4π x F → 3/(2 x²)·… ∝ t⁰·12/6.
        let ends = integrand(1e-4) + integrand(1.0);
        let sum = h / 3.0 * (inner + ends);
        assert!((sum - (1.0 - (8f64 / 9.0).sqrt())).abs() < 1e-6, "{sum}");
    }

    #[test]
    fn the_shifts_of_the_innermost_orbit_are_known() {
        // Light along and against the motion there, by its angular momentum: b of a ray that is tangential at r = 3.
        let b = 3.0 / (1.0 - 1.0 / 3f64).sqrt();
        let shift = |l| 1.0 / emitted_frequency(3.0, l);
        assert!((shift(b) - 2f64.sqrt()).abs() < 1e-14);
        assert!((shift(-b) - 2f64.sqrt() / 3.0).abs() < 1e-14);
        assert!(emitted_frequency(1.5, 0.0).is_nan());
    }
}
