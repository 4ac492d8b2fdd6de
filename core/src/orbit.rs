//! The orbit of a light ray by its phase: the inverse radius as a function of the orbital angle from infinity, and the
//! inverse of that function.
//!
//! Let a ray come from infinity with impact parameter b. Its *phase* ψ is the orbital angle from there, so that u(0) = 0
//! and u′(0) = 1/b. One function of ψ and b serves every observer: traced backwards, an outward leg of a path at the
//! orbital angle φ from the observer has ψ = φ_∞ − φ, and an inward leg has ψ = φ plus the phase of the observer.
//!
//! **The closed form.** (du/dψ)² = f(u) = u³ − u² + 1/b² has the solution (Biermann and Weierstrass; Whittaker and
//! Watson, A Course of Modern Analysis, §20.6, from u = 0)
//!
//! ```text
//! u = (1/(4b²) − ℘′(ψ)/b) / (2 (℘(ψ) + 1/12)²),    g₂ = 1/12,    g₃ = 1/216 − 1/(16 b²)
//! ```
//!
//! It needs no roots of the cubic, and so no case distinction at the critical impact parameter. ℘ comes from five terms
//! of its Laurent series at ψ/8 and three duplications. Both are scaled by powers of ψ, so that only ψ and ψ/b occur
//! and nothing is divided by ψ.

use crate::Ray;
use crate::exact::phi_outward;

/// Number of duplications: with them the series is needed only where its terms fall by a factor of 1000.
const DUPLICATIONS: i32 = 3;

/// u = 1/r at the phase `phase` ≥ 0 (rad) of the ray with 1/b = `inv_b`, before the periapsis or, if the ray is captured,
/// above the horizon: not beyond. The error relative to u is about 1e-14.
///
/// ```
/// use lensbake_core::orbit;
///
/// // A ray of b = 4 turns round at r = 3.17; a quarter of a turn from infinity it is at r = 3.22.
/// let u = orbit::inverse_radius(0.25, std::f64::consts::FRAC_PI_2);
/// let phase = orbit::phase(0.25, u).unwrap();
/// assert!((phase - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
/// ```
pub fn inverse_radius(inv_b: f64, phase: f64) -> f64 {
    let (sigma, phase_sq) = (inv_b * phase, phase * phase);
    let scale = 0.25f64.powi(DUPLICATIONS);
    let w = phase_sq * scale;
    // g₂ w² and g₃ w³, and the series of w ℘(√w).
    let mut a = w * w / 12.0;
    let mut c = w * w * (w / 216.0 - sigma * sigma * scale / 16.0);
    let mut p = 1.0 + a / 20.0 + c / 28.0 + a * a / 1200.0 + 3.0 * a * c / 6160.0;
    for _ in 0..DUPLICATIONS {
        let numerator = (p * p + 0.25 * a).powi(2) + 2.0 * c * p;
        p = numerator / (p * (p * p - 0.25 * a) - 0.25 * c);
        a *= 16.0;
        c *= 64.0;
    }
    let above_pole = p + phase_sq / 12.0;
    let minus_derivative = (4.0 * p * p * p - a * p - c).max(0.0).sqrt();
    sigma * (minus_derivative + 0.25 * sigma * phase_sq) / (2.0 * above_pole * above_pole)
}

/// du/dψ at the inverse radius `u` of the ray with 1/b = `inv_b`, before the periapsis; `None` if the ray does not come
/// so near to the hole, or lies on the other side of the critical impact parameter.
pub fn slope(inv_b: f64, u: f64) -> Option<f64> {
    let square = inv_b * inv_b - u * u * (1.0 - u);
    (square >= 0.0).then(|| square.sqrt())
}

/// The phase (rad) at which the ray with 1/b = `inv_b` is at the inverse radius `u` for the first time: the inverse of
/// [`inverse_radius`], by Carlson's R_F. `None` if it does not come so near to the hole. For u < 2/3.
pub fn phase(inv_b: f64, u: f64) -> Option<f64> {
    let slope = slope(inv_b, u)?;
    if u == 0.0 {
        return Some(0.0);
    }
    Some(phi_outward(&Ray::leaving(u, inv_b, slope)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::B_CRIT;
    use proptest::prelude::*;

    /// 1/b, crowded at the critical value.
    fn inverse_impact_parameters() -> impl Strategy<Value = f64> {
        prop_oneof![
            1e-6..1.0 / B_CRIT,
            1.0 / B_CRIT..3.0,
            (1.0..14.0).prop_map(|n: f64| (1.0 + 10f64.powf(-n)) / B_CRIT),
            (1.0..14.0).prop_map(|n: f64| (1.0 - 10f64.powf(-n)) / B_CRIT),
            Just(1.0 / B_CRIT),
            3.0..1e6,
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn the_phase_is_the_inverse_of_the_radius(inv_b in inverse_impact_parameters(), part in 0.0..0.999f64) {
            // Up to the periapsis, or to r = 2.
            let highest = if inv_b * B_CRIT < 1.0 { turning_point(inv_b).min(0.5) } else { 0.5 };
            let u = part * highest;
            let phase = phase(inv_b, u).unwrap();
            let again = inverse_radius(inv_b, phase);
            prop_assert!((again / u - 1.0).abs() < 1e-11 || u == 0.0, "{u} {again}");
        }
    }

    /// The smaller positive root of u³ − u² + 1/b², by bisection.
    fn turning_point(inv_b: f64) -> f64 {
        let (mut low, mut high) = (0.0, 2.0 / 3.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            match slope(inv_b, middle) {
                Some(_) => low = middle,
                None => high = middle,
            }
        }
        low
    }
}
