//! The normalised shadow coordinate x.

use crate::B_CRIT;

/// Low-order part of b_c: the f64 nearest to b_c − [`B_CRIT`]. With it, b − b_c keeps full precision.
const B_CRIT_REST: f64 = -7.151_834_159_792_777e-17;

/// The normalised shadow coordinate x of a view direction, together with 1 − x, each to full relative accuracy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadowCoordinate {
    /// x = tan(θ_c/2) / tan(θ/2).
    pub x: f64,
    /// 1 − x: positive outside the shadow, zero or negative inside.
    pub one_minus_x: f64,
}

impl ShadowCoordinate {
    /// The coordinate x = 1 − s².
    pub fn from_s(s: f64) -> Self {
        ShadowCoordinate {
            x: (1.0 - s) * (1.0 + s),
            one_minus_x: s * s,
        }
    }

    /// The coordinate x = b_c/b of the impact parameter `b`, for an observer at infinity. It is accurate even at
    /// the f64 values of b next to b_c, on either side.
    pub fn from_b(b: f64) -> Self {
        ShadowCoordinate {
            x: B_CRIT / b,
            one_minus_x: ((b - B_CRIT) - B_CRIT_REST) / b,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// b_c = 2.598 076 211 353 315 94… lies between two adjacent f64 values.
    #[test]
    fn the_edge_lies_between_two_impact_parameters() {
        assert!(ShadowCoordinate::from_b(B_CRIT).one_minus_x > 0.0);
        assert!(ShadowCoordinate::from_b(B_CRIT.next_down()).one_minus_x < 0.0);
    }
}
