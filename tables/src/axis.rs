//! The axes along which a row may be tabulated: the map from the normalised shadow coordinate x to the position q
//! along the row, its inverse, and the value that is stored at q.
//!
//! The bending Δ (deflection angle) diverges at the shadow boundary (x = 1). With d = 1 − x and C = cos θ_c, at
//! every r,
//!
//! ```text
//! Δ = −(1 + (5/18) C d + O(d²)) ln d + a smooth function of d
//! ```
//!
//! (r = ∞: Iyer & Petters 2007, Gen. Rel. Grav. 39, 1563). The residual axis stores the bending without the
//! logarithms, at positions q = √(1−√x): q² ∝ d at the shadow boundary, and x ∝ (1−q)² straight away from the
//! hole, where the row of a distant observer has a layer as narrow as the observer's shadow. Compared with
//! s = √(1−x) and the leading logarithm alone, both changes together reduce the error of 64 texels for r = ∞ from
//! 7e-6 to 2e-8 rad (`docs/chart.md`).
//!
//! Below the horizon C falls without bound towards the singularity, and the row crowds at both ends: within 1 − x of
//! about 1/|C| at the shadow boundary, and straight away. The residual axis therefore uses the *row coordinate* there,
//!
//! ```text
//! X = x / (x + σ (1−x)),     σ = ((1−C)/2)^(3/5),     √X = 1 − (7/4) q² + (3/4) q⁴
//! ```
//!
//! in place of x and √x = 1 − q², and (5/18) C/σ in place of (5/18) C. X has the same ends as x, and σ = 1 at the horizon.
//! The exponent and the coefficients of q were chosen for the smallest error of 64 texels from r = 1 to 0.01, in rad and
//! in pixels (`docs/motion.md`).

use crate::TableError;
use lensbake_core::{B_CRIT, BendAndSlope, Observer, ShadowCoordinate};
#[cfg(feature = "files")]
use serde::{Deserialize, Serialize};

/// The axis of a row. The position q runs from 0 at the first texel to 1 at the last.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize))]
pub enum Axis {
    /// q = √(1−√x); stores the residual R = Δ + (1 + (5/18) C d) ln d, which is bounded and smooth. For every
    /// observer and every x outside the shadow.
    Residual,
    /// Uniform in b; stores Δφ. For the observer at infinity only.
    UniformB {
        /// b at the first texel, > b_c.
        b_min: f64,
        /// b at the last texel.
        b_max: f64,
    },
    /// Uniform in 1/b, with b_min at the first texel; stores Δφ. For the observer at infinity only.
    UniformInverseB {
        /// b at the first texel, > b_c.
        b_min: f64,
        /// b at the last texel.
        b_max: f64,
    },
    /// Uniform in ln(b/b_c − 1); stores Δφ. For the observer at infinity only.
    UniformLogB {
        /// b at the first texel, > b_c.
        b_min: f64,
        /// b at the last texel.
        b_max: f64,
    },
    /// The residual axis as the rows below the horizon use it ([`Axis::of`]). In files it is called residual, too.
    ResidualBelow,
}

/// √X = 1 − (1 + e) q² + e q⁴ on the residual axis below the horizon.
pub(crate) const STRETCH: f64 = 0.75;
/// Bound on |dX/dq|, which is 0 straight away from the hole, where the stored slope is 0 as well.
pub(crate) const SMALLEST_SLOPE: f64 = 1e-9;
/// Exponent of σ = ((1−C)/2)^(3/5).
const SCALE_EXPONENT: f64 = 0.6;

/// The value that a row stores at a position q along its axis, and its slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stored {
    /// The value, rad.
    pub value: f64,
    /// Its derivative with respect to q.
    pub slope: f64,
}

impl Axis {
    /// Name of the axis on the command line and in files.
    pub fn name(&self) -> &'static str {
        match self {
            Axis::Residual | Axis::ResidualBelow => "residual",
            Axis::UniformB { .. } => "b",
            Axis::UniformInverseB { .. } => "inverse-b",
            Axis::UniformLogB { .. } => "log-b",
        }
    }

    /// The axis of the row of `observer` in a table on this axis.
    pub fn of(self, observer: &Observer) -> Self {
        match self {
            Axis::Residual if observer.is_inside() => Axis::ResidualBelow,
            other => other,
        }
    }

    /// Whether it stores the bending without its logarithms.
    pub fn is_residual(self) -> bool {
        matches!(self, Axis::Residual | Axis::ResidualBelow)
    }

    /// The range (b_min, b_max) of an axis in b; `None` for the residual axis, which has no such limits.
    pub fn b_range(&self) -> Option<(f64, f64)> {
        match *self {
            Axis::Residual | Axis::ResidualBelow => None,
            Axis::UniformB { b_min, b_max }
            | Axis::UniformInverseB { b_min, b_max }
            | Axis::UniformLogB { b_min, b_max } => Some((b_min, b_max)),
        }
    }

    /// Checks that the ray at `at` lies within the range of the axis. Captured rays always pass.
    ///
    /// # Errors
    /// [`TableError::OutsideAxis`] if its impact parameter is outside the range of an axis in b, by more than the
    /// rounding of b.
    pub fn check_reach(&self, at: ShadowCoordinate) -> Result<(), TableError> {
        const ROUNDING: f64 = 1e-12;
        let Some((b_min, b_max)) = self.b_range() else {
            return Ok(());
        };
        let b = B_CRIT / at.x;
        let reach = b_min * (1.0 - ROUNDING)..=b_max * (1.0 + ROUNDING);
        if at.one_minus_x <= 0.0 || reach.contains(&b) {
            Ok(())
        } else {
            Err(TableError::OutsideAxis { b, b_min, b_max })
        }
    }

    /// The normalised shadow coordinate x at the position `q` in [0, 1] of the row of `observer`.
    pub fn shadow_coordinate(&self, observer: &Observer, q: f64) -> ShadowCoordinate {
        self.shadow_coordinate_at(observer, self.coordinate(q))
    }

    /// The normalised shadow coordinate x at the row coordinate `at` of `observer`: the inverse of
    /// [`Axis::row_coordinate`].
    pub fn shadow_coordinate_at(
        &self,
        observer: &Observer,
        at: ShadowCoordinate,
    ) -> ShadowCoordinate {
        match self {
            // The inverse of a scaling by σ is that by 1/σ.
            Axis::ResidualBelow => scaled(at, 1.0 / self.edge_scale(observer)),
            _ => at,
        }
    }

    /// dx/dq at the position `q` of the row of `observer`.
    pub(crate) fn shadow_coordinate_slope(&self, observer: &Observer, q: f64) -> f64 {
        self.coordinate_slope(q) / self.row_coordinate_slope(observer, self.coordinate(q))
    }

    /// The row coordinate X of the normalised shadow coordinate `at` of `observer`: x above the horizon.
    #[inline]
    pub fn row_coordinate(&self, observer: &Observer, at: ShadowCoordinate) -> ShadowCoordinate {
        match self {
            Axis::ResidualBelow => scaled(at, self.edge_scale(observer)),
            _ => at,
        }
    }

    /// dX/dx at the row coordinate `at`: (1 − X + σX)²/σ.
    fn row_coordinate_slope(&self, observer: &Observer, at: ShadowCoordinate) -> f64 {
        let scale = self.edge_scale(observer);
        (at.one_minus_x + scale * at.x).powi(2) / scale
    }

    /// σ; 1 above the horizon.
    #[inline]
    pub fn edge_scale(&self, observer: &Observer) -> f64 {
        match self {
            Axis::ResidualBelow => (0.5 - 0.5 * observer.cos_shadow_at_rest()).powf(SCALE_EXPONENT),
            _ => 1.0,
        }
    }

    /// (5/18) C/σ, the coefficient of d ln d relative to that of ln d, with d = 1 − X.
    #[inline]
    pub fn log_weight(&self, observer: &Observer) -> f64 {
        5.0 / 18.0 * observer.cos_shadow_at_rest() / self.edge_scale(observer)
    }

    /// Position q of a row coordinate outside the shadow. It is below 0 or above 1 beyond the range
    /// of the axis; a lookup clamps it, as a texture does.
    #[inline]
    pub fn position(&self, at: ShadowCoordinate) -> f64 {
        let between = |value: f64, first: f64, last: f64| (value - first) / (last - first);
        match *self {
            Axis::Residual => (at.one_minus_x / (1.0 + at.x.sqrt())).sqrt(),
            Axis::ResidualBelow => {
                // The root of e q⁴ − (1+e) q² + (1 − √X), without cancellation.
                let root = at.x.sqrt();
                let rest = at.one_minus_x / (1.0 + root);
                let discriminant = (1.0 - STRETCH).powi(2) + 4.0 * STRETCH * root;
                (2.0 * rest / (1.0 + STRETCH + discriminant.sqrt())).sqrt()
            }
            Axis::UniformB { b_min, b_max } => between(B_CRIT / at.x, b_min, b_max),
            Axis::UniformInverseB { b_min, b_max } => between(at.x, B_CRIT / b_min, B_CRIT / b_max),
            Axis::UniformLogB { b_min, b_max } => between(
                (at.one_minus_x / at.x).ln(),
                log_excess(b_min),
                log_excess(b_max),
            ),
        }
    }

    /// The row coordinate at the position `q` in [0, 1]: the inverse of [`Axis::position`].
    pub fn coordinate(&self, q: f64) -> ShadowCoordinate {
        let between = |first: f64, last: f64| first + q * (last - first);
        match *self {
            Axis::Residual => {
                let root = (1.0 - q) * (1.0 + q);
                ShadowCoordinate {
                    x: root * root,
                    one_minus_x: q * q * (1.0 + root),
                }
            }
            Axis::ResidualBelow => {
                let square = q * q;
                let root = (1.0 - square) * (1.0 - STRETCH * square);
                let rest = square * (1.0 + STRETCH * (1.0 - square));
                ShadowCoordinate {
                    x: root * root,
                    one_minus_x: rest * (1.0 + root),
                }
            }
            Axis::UniformB { b_min, b_max } => ShadowCoordinate::from_b(between(b_min, b_max)),
            Axis::UniformInverseB { b_min, b_max } => {
                ShadowCoordinate::from_b(1.0 / between(1.0 / b_min, 1.0 / b_max))
            }
            Axis::UniformLogB { b_min, b_max } => {
                let excess = between(log_excess(b_min), log_excess(b_max)).exp();
                ShadowCoordinate {
                    x: 1.0 / (1.0 + excess),
                    one_minus_x: excess / (1.0 + excess),
                }
            }
        }
    }

    /// dX/dq at the position q, X being the row coordinate.
    pub fn coordinate_slope(&self, q: f64) -> f64 {
        let x = self.coordinate(q).x;
        match *self {
            Axis::Residual => -4.0 * q * x.sqrt(),
            Axis::ResidualBelow => -4.0 * q * x.sqrt() * (1.0 + STRETCH * (1.0 - 2.0 * q * q)),
            Axis::UniformB { b_min, b_max } => -x * x / B_CRIT * (b_max - b_min),
            Axis::UniformInverseB { b_min, b_max } => B_CRIT * (1.0 / b_max - 1.0 / b_min),
            Axis::UniformLogB { b_min, b_max } => {
                -x * (1.0 - x) * (log_excess(b_max) - log_excess(b_min))
            }
        }
    }

    /// The value and slope that are stored at the position q for the given bending of `observer`. On the residual
    /// axis q must be > 0, because the value at q = 0 is a limit.
    pub fn stored(&self, observer: &Observer, q: f64, bending: BendAndSlope) -> Stored {
        let at = self.coordinate(q);
        let logarithm = self.logarithm(observer, at);
        Stored {
            value: bending.bend - logarithm.bend,
            slope: (bending.slope / self.row_coordinate_slope(observer, at) - logarithm.slope)
                * self.coordinate_slope(q),
        }
    }

    /// The inverse of [`Axis::stored`]: the bending and dΔ/dx at the row coordinate `at`, from the stored value and
    /// slope.
    pub fn bending(
        &self,
        observer: &Observer,
        at: ShadowCoordinate,
        stored: Stored,
    ) -> BendAndSlope {
        let logarithm = self.logarithm(observer, at);
        let q = self.position(at).clamp(0.0, 1.0);
        let dx_dq = self.coordinate_slope(q).min(-SMALLEST_SLOPE);
        BendAndSlope {
            bend: stored.value + logarithm.bend,
            slope: (stored.slope / dx_dq + logarithm.slope)
                * self.row_coordinate_slope(observer, at),
        }
    }

    /// The bending Δ at the row coordinate `at` from the stored value, rad: [`Axis::bending`] without the slope.
    #[inline]
    pub fn bend(&self, observer: &Observer, at: ShadowCoordinate, value: f64) -> f64 {
        value + self.logarithm(observer, at).bend
    }

    /// The logarithmic part of the bending, which the residual axis subtracts before storing, and its derivative
    /// with respect to the row coordinate; zero for the other axes.
    #[inline]
    fn logarithm(&self, observer: &Observer, at: ShadowCoordinate) -> BendAndSlope {
        if !self.is_residual() {
            return BendAndSlope {
                bend: 0.0,
                slope: 0.0,
            };
        }
        let (d, weight) = (at.one_minus_x, self.log_weight(observer));
        let (factor, ln) = (1.0 + weight * d, d.ln());
        BendAndSlope {
            bend: -factor * ln,
            slope: weight * ln + factor / d,
        }
    }
}

fn scaled(at: ShadowCoordinate, scale: f64) -> ShadowCoordinate {
    let ShadowCoordinate { x, one_minus_x } = at;
    let sum = x + scale * one_minus_x;
    ShadowCoordinate {
        x: x / sum,
        one_minus_x: scale * one_minus_x / sum,
    }
}

/// ln(b/b_c − 1), accurate even at the f64 values of b next to b_c.
fn log_excess(b: f64) -> f64 {
    let at = ShadowCoordinate::from_b(b);
    (at.one_minus_x / at.x).ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGE: (f64, f64) = (2.6, 200.0);

    fn axes() -> [Axis; 5] {
        let (b_min, b_max) = RANGE;
        [
            Axis::Residual,
            Axis::ResidualBelow,
            Axis::UniformB { b_min, b_max },
            Axis::UniformInverseB { b_min, b_max },
            Axis::UniformLogB { b_min, b_max },
        ]
    }

    #[test]
    fn position_and_coordinate_are_inverse() {
        for axis in axes() {
            for i in 0..=100 {
                let q = f64::from(i) / 100.0;
                let at = axis.coordinate(q);
                assert!((at.x + at.one_minus_x - 1.0).abs() < 1e-15);
                assert!((axis.position(at) - q).abs() < 1e-11, "{axis:?} at {q}");
            }
        }
    }

    #[test]
    fn the_slope_of_the_coordinate_is_its_derivative() {
        for axis in axes() {
            for i in 1..20 {
                let (q, h) = (f64::from(i) / 20.0, 1e-5);
                let numeric = (axis.coordinate(q + h).x - axis.coordinate(q - h).x) / (2.0 * h);
                let slope = axis.coordinate_slope(q);
                assert!(
                    (slope - numeric).abs() < 1e-4 * slope.abs(),
                    "{axis:?} at {q}"
                );
            }
        }
    }

    #[test]
    fn stored_and_bend_are_inverse() {
        let bend = BendAndSlope {
            bend: 0.7,
            slope: 1.9,
        };
        for axis in axes() {
            for i in 1..20 {
                let q = f64::from(i) / 20.0;
                let far = match axis {
                    Axis::ResidualBelow => Observer::falling(0.1).unwrap(),
                    _ => Observer::at_infinity(),
                };
                let stored = axis.stored(&far, q, bend);
                let back = axis.bending(&far, axis.coordinate(q), stored);
                assert!((back.bend - bend.bend).abs() < 1e-12, "{axis:?} at {q}");
                let alone = axis.bend(&far, axis.coordinate(q), stored.value);
                assert!((alone - bend.bend).abs() < 1e-12, "{axis:?} at {q}");
                assert!((back.slope - bend.slope).abs() < 1e-9, "{axis:?} at {q}");
            }
        }
    }
}
