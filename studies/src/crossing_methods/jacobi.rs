//! The closed form in Jacobi's elliptic functions, from the roots of the cubic, as in Luminet (1979, A&A 75, 228) and most
//! codes since.
//!
//! With the roots u₁ < 0 < u₂ < u₃ of u³ − u² + 1/b² the ray is u = u₁ + (u₂ − u₁) sn²(½ √(u₃ − u₁) ψ + c), and if only u₁
//! is real (b < b_c), u = u₁ + A (1 − cn(√A ψ + c))/(1 + cn(√A ψ + c)) with A² = 3u₁² − 2u₁. The addition theorems take the
//! functions at c from u = 0, so that no integral is needed for c.

use super::{Arithmetic, CrossingInfo, Kind, Orbit};
use std::marker::PhantomData;

/// The closed form in sn and cn, in the arithmetic of `T`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Jacobi<T>(PhantomData<T>);

/// Most steps of the arithmetic–geometric mean.
const MOST_STEPS: usize = 8;

/// sn, cn and dn of an argument.
#[derive(Debug, Clone, Copy)]
struct Elliptic<T> {
    sn: T,
    cn: T,
    dn: T,
}

impl<T: Arithmetic> Orbit for Jacobi<T> {
    type Number = T;

    fn info(&self) -> CrossingInfo {
        CrossingInfo {
            kind: Kind::Jacobi,
            name: "Jacobi sn, cn",
            knobs: String::new(),
            source: "Luminet 1979; Bulirsch 1965",
            used: false,
        }
    }

    fn inverse_radius(&self, inv_b: T, phase: T) -> T {
        let kappa = T::constant(4.0 / 27.0) - inv_b * inv_b;
        match kappa >= T::zero() {
            true => turning(inv_b, kappa, phase),
            false => captured(kappa, phase),
        }
    }
}

/// Of a ray that turns round: three real roots.
fn turning<T: Arithmetic>(inv_b: T, kappa: T, phase: T) -> T {
    let c = T::constant;
    let root = kappa.sqrt();
    let half = c(1.0 / 3.0) * inv_b.atan2(root);
    let half_rest = c(std::f64::consts::FRAC_PI_6) - half;
    let u1 = c(-4.0 / 3.0) * half.sin() * (c(std::f64::consts::FRAC_PI_6) + half).cos();
    let span = c(2.0 / 3.0f64.sqrt()) * (half + half).sin();
    let gap = c(2.0 / 3.0f64.sqrt()) * (half_rest + half_rest).sin();
    let whole = span + gap;
    let (k_sq, complement) = (span / whole, gap / whole);
    let sn_sq = -u1 / span;
    let start = Elliptic {
        sn: sn_sq.sqrt(),
        cn: (T::one() - sn_sq).sqrt(),
        dn: (T::one() - k_sq * sn_sq).sqrt(),
    };
    let turned = elliptic(c(0.5) * whole.sqrt() * phase, complement);
    let sn = (turned.sn * start.cn * start.dn + start.sn * turned.cn * turned.dn)
        / (T::one() - k_sq * turned.sn * turned.sn * sn_sq);
    u1 + span * sn * sn
}

/// Of a ray that is captured: one real root.
fn captured<T: Arithmetic>(kappa: T, phase: T) -> T {
    let c = T::constant;
    let v = {
        let q = c(0.5) * (c(-27.0) * kappa).sqrt();
        let sinh = (q.asinh() * c(1.0 / 3.0)).sinh();
        c(4.0 / 3.0) * sinh * sinh
    };
    let u1 = c(-1.0 / 3.0) - v;
    let a = (u1 * (c(3.0) * u1 - c(2.0))).sqrt();
    // k² and 1 − k² of the quadratic factor t² + (3u₁ − 1) t + A², t = u − u₁.
    let lean = (c(3.0) * u1 - T::one()) / (c(4.0) * a);
    let (k_sq, complement) = (c(0.5) - lean, c(0.5) + lean);
    let cn_start = (a + u1) / (a - u1);
    let sn_sq = T::one() - cn_start * cn_start;
    let start = Elliptic {
        sn: sn_sq.sqrt(),
        cn: cn_start,
        dn: (T::one() - k_sq * sn_sq).sqrt(),
    };
    let turned = elliptic(a.sqrt() * phase, complement);
    let cn = (turned.cn * start.cn - turned.sn * turned.dn * start.sn * start.dn)
        / (T::one() - k_sq * turned.sn * turned.sn * sn_sq);
    u1 + a * (T::one() - cn) / (T::one() + cn)
}

/// sn, cn and dn at `x` ≥ 0 for the complementary parameter 1 − k² = `complement`, by the arithmetic–geometric mean and
/// Landen's transformation (Bulirsch 1965, Numer. Math. 7, 78).
fn elliptic<T: Arithmetic>(x: T, complement: T) -> Elliptic<T> {
    let half = T::constant(0.5);
    let close = T::epsilon().sqrt();
    let mut means = [[T::one(); 2]; MOST_STEPS];
    let (mut a, mut product, mut used) = (T::one(), complement.max(T::min_positive_value()), 0);
    let mut mean = a;
    for step in &mut means {
        let g = product.sqrt();
        *step = [a, g];
        used += 1;
        mean = half * (a + g);
        if (a - g).abs() <= close * a {
            break;
        }
        product = g * a;
        a = mean;
    }
    let (sin, cos) = (mean * x).sin_cos();
    if sin == T::zero() {
        return Elliptic {
            sn: sin,
            cn: cos,
            dn: T::one(),
        };
    }
    let mut dn = T::one();
    let mut ratio = cos / sin;
    let mut c = mean * ratio;
    for &[a, g] in means[..used].iter().rev() {
        ratio = ratio * c;
        c = c * dn;
        dn = (g + ratio) / (a + ratio);
        ratio = c / a;
    }
    let sn = (c * c + T::one()).sqrt().recip() * sin.signum();
    Elliptic { sn, cn: c * sn, dn }
}
