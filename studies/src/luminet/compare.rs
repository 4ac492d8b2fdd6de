//! What Luminet's paper states in numbers, as others quote it, beside what is computed here.

use super::M_PER_RADIUS;
use lensbake_core::{B_CRIT, Ray, accretion, exact};

/// A published number and ours.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// What it is.
    pub what: &'static str,
    /// As published.
    pub published: f64,
    /// As computed here.
    pub computed: f64,
    /// Who quotes the published number.
    pub quoted_by: &'static str,
}

const TRANSCRIPT: &str = "cabenavidesg.github.io/LuminetPaper, section 2";
const PACKAGE: &str = "the Python package luminet 0.2.3, after his equation 15";

/// The published numbers that could be found, with ours.
pub fn comparisons() -> Vec<Comparison> {
    let comparison = |what, published, computed, quoted_by| Comparison {
        what,
        published,
        computed,
        quoted_by,
    };
    let brightest = accretion::BRIGHTEST_RADIUS * M_PER_RADIUS;
    vec![
        comparison(
            "critical impact parameter b_c, M",
            5.19695,
            B_CRIT * M_PER_RADIUS,
            TRANSCRIPT,
        ),
        comparison(
            "(b - b_c) exp(deflection) near b_c, M",
            3.4823,
            strong_deflection(),
            TRANSCRIPT,
        ),
        comparison(
            "radius where the disc emits most, M",
            9.55,
            brightest,
            PACKAGE,
        ),
    ]
}

/// (b − b_c) e^μ in the limit b → b_c, with μ the deflection angle, M.
fn strong_deflection() -> f64 {
    let excess = 1e-9;
    let bend = Ray::from_infinity(B_CRIT + excess).map(|ray| exact::bend(&ray));
    let bend = bend.ok().and_then(|bend| bend.escaped());
    bend.map_or(f64::NAN, |bend| excess * bend.exp() * M_PER_RADIUS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_computed_is_what_was_published() {
        for Comparison {
            what,
            published,
            computed,
            ..
        } in comparisons()
        {
            assert!(
                (computed / published - 1.0).abs() < 2e-4,
                "{what}: {computed} {published}"
            );
        }
    }
}
