//! The lookup of many rays at once: the same formulae as [`Row::bend`], computed for several rays by one instruction.
//!
//! What takes the time of a lookup is a logarithm, two square roots and a division, which a processor has for several
//! numbers at a time, the logarithm as a polynomial. The loops below are over arrays of a fixed number of rays, which the
//! compiler turns into such instructions; `pulp` compiles them for AVX2 as well and chooses when the program runs. No
//! sum is reordered and no product is fused with a sum, so that every processor gives the same bits.
//!
//! The row is stored as the coefficients of a cubic in each interval between two texels: one ray reads them from one
//! place.

pub(crate) mod lanes;
mod logarithm;
pub(crate) mod sines;
mod single;

pub use single::RowBatchF32;

use crate::axis::{SMALLEST_SLOPE, STRETCH};
use crate::interpolation::cubic_coefficients;
use crate::{Axis, Interpolation, Row};
use lanes::{Batched, each, in_lanes};
use lensbake_core::{BendAndSlope, ShadowCoordinate};
use logarithm::ln;
use pulp::{Arch, NullaryFnOnce};

/// Rays that are looked up together.
const LANES: usize = 8;

/// A number for each ray.
type Lanes = [f64; LANES];

/// 3 · 2⁵¹: a sum with it is rounded to an integer, which is then in the lowest bits.
pub(crate) const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// A row prepared for lookups of many rays in f64, made by [`Row::batch`]. The results are those of [`Row::bend`] and
/// [`Row::bend_and_slope`] up to rounding; what they return as [`RayOutcome::Captured`](lensbake_core::RayOutcome::Captured) is NaN.
#[derive(Debug, Clone)]
pub struct RowBatch<'a> {
    row: &'a Row,
    /// The cubic in each interval between two texels; an interval is one long.
    cubics: Vec<[f64; 4]>,
    log_weight: f64,
    edge_scale: f64,
}

impl Row {
    /// The bending Δ at each of the normalised shadow coordinates `at`, rad: [`Row::bend`] of many rays at a fraction of the
    /// cost. NaN for a captured ray.
    ///
    /// [`Row::batch`] does not allocate, and [`Row::bend_many_f32`] is faster.
    ///
    /// ```
    /// use lensbake_core::{Observer, RayOutcome};
    /// use lensbake_tables::default_atlas;
    ///
    /// let observer = Observer::at(10.0).unwrap();
    /// let row = default_atlas().row(observer).unwrap();
    /// // Cosine and sine of the angle from the direction of the hole: no trigonometric function for each ray.
    /// let at: Vec<_> = [[0.8_f64, 0.6], [0.0, 1.0], [-0.6, 0.8], [0.99, 0.02_f64.sqrt()]]
    ///     .map(|[cos, sin]| observer.shadow_coordinate_of(cos, sin))
    ///     .to_vec();
    /// let bends = row.bend_many(&at);
    /// assert!((bends[1] - row.bend(at[1]).escaped().unwrap()).abs() < 1e-14);
    /// assert!(bends[3].is_nan() && row.bend(at[3]) == RayOutcome::Captured);
    /// ```
    pub fn bend_many(&self, at: &[ShadowCoordinate]) -> Vec<f64> {
        let mut bends = vec![0.0; at.len()];
        self.batch().bend(at, &mut bends);
        bends
    }

    /// The bending Δ in f32 at each value of 1 − x, rad: NaN for a captured ray. [`RowBatchF32::bend`] states the error.
    ///
    /// ```
    /// use lensbake_core::Observer;
    /// use lensbake_tables::default_atlas;
    ///
    /// // From infinity, x = b_c/b: the rays with b = 2 b_c, 1.001 b_c, and one that is captured.
    /// let row = default_atlas().row(Observer::at_infinity()).unwrap();
    /// let bends = row.bend_many_f32(&[0.5, 0.001 / 1.001, -0.1]);
    /// assert!((bends[0] - 0.556_910_6).abs() < 1e-6 && bends[2].is_nan());
    /// ```
    pub fn bend_many_f32(&self, one_minus_x: &[f32]) -> Vec<f32> {
        let mut bends = vec![0.0; one_minus_x.len()];
        self.batch_f32().bend(one_minus_x, &mut bends);
        bends
    }

    /// The row prepared for lookups of many rays. Making it takes as long as some twenty lookups.
    pub fn batch(&self) -> RowBatch<'_> {
        RowBatch {
            row: self,
            cubics: self.cubics(),
            log_weight: self.axis().log_weight(self.observer()),
            edge_scale: self.axis().edge_scale(self.observer()),
        }
    }

    /// The row prepared for lookups of many rays in f32.
    pub fn batch_f32(&self) -> RowBatchF32<'_> {
        RowBatchF32::new(self.batch())
    }

    /// The polynomial between the texels of each interval.
    pub(crate) fn cubics(&self) -> Vec<[f64; 4]> {
        let cubic = |ends: &[[f64; 2]]| match self.interpolation() {
            Interpolation::Hermite => cubic_coefficients(ends[0], ends[1]),
            Interpolation::Linear => [ends[0][0], ends[1][0] - ends[0][0], 0.0, 0.0],
        };
        self.texels().windows(2).map(cubic).collect()
    }
}

impl RowBatch<'_> {
    /// Writes the bending Δ at each of the coordinates `at` to `bends`, rad; NaN for a captured ray. If the lengths
    /// differ, the rest of the longer slice is left alone.
    pub fn bend(&self, at: &[ShadowCoordinate], bends: &mut [f64]) {
        if !self.row.axis().is_residual() {
            for (&at, bend) in at.iter().zip(bends) {
                *bend = self.row.bend(at).escaped().unwrap_or(f64::NAN);
            }
            return;
        }
        Arch::new().dispatch(Lookup {
            batch: self,
            at,
            results: bends,
        });
    }

    /// Writes the bending Δ and dΔ/dx at each of the coordinates `at` to `bendings`; both NaN for a captured ray. If the
    /// lengths differ, the rest of the longer slice is left alone.
    pub fn bend_and_slope(&self, at: &[ShadowCoordinate], bendings: &mut [BendAndSlope]) {
        if !self.row.axis().is_residual() {
            for (&at, bending) in at.iter().zip(bendings) {
                *bending = self.row.bend_and_slope(at).escaped().unwrap_or(CAPTURED);
            }
            return;
        }
        Arch::new().dispatch(Lookup {
            batch: self,
            at,
            results: &mut *bendings,
        });
        // As in Row::bend_and_slope, where rounding would be all that is left.
        let observer = self.row.observer();
        for (&at, bending) in at.iter().zip(bendings) {
            if let Some(away) = observer.bend_straight_away(at) {
                *bending = away;
            }
        }
    }

    /// The values and the slopes dΔ/dx of [`LANES`] rays. `BELOW` is the side of the horizon.
    #[inline(always)]
    fn look_up<const BELOW: bool>(&self, at: &[ShadowCoordinate; LANES]) -> [Lanes; 2] {
        let (weight, scale) = (self.log_weight, self.edge_scale);
        let [x, d] = self.row_coordinates::<BELOW>(at);
        let root: Lanes = each(|i| x[i].sqrt());
        let q: Lanes = each(|i| position::<BELOW>(root[i], d[i]));
        let last = self.cubics.len() as f64;
        let texels: Lanes = each(|i| q[i].clamp(0.0, 1.0) * last);
        // At the last texel it is the last interval, and t is 1.
        let rounded: Lanes = each(|i| (texels[i] - 0.5 + ROUNDING).min(last - 1.0 + ROUNDING));
        let t: Lanes = each(|i| texels[i] - (rounded[i] - ROUNDING));
        let cubic: [[f64; 4]; LANES] = each(|i| self.cubic(rounded[i].to_bits()));
        let ln: Lanes = each(|i| ln(d[i]));
        let captured = |i: usize| at[i].one_minus_x <= 0.0;
        let bend: Lanes = each(|i| {
            let [c0, c1, c2, c3] = cubic[i];
            let value = c0 + t[i] * (c1 + t[i] * (c2 + t[i] * c3));
            let bend = value - (1.0 + weight * d[i]) * ln[i];
            if captured(i) { f64::NAN } else { bend }
        });
        let stretch = |i: usize| match BELOW {
            true => 1.0 + STRETCH * (1.0 - 2.0 * q[i] * q[i]),
            false => 1.0,
        };
        let dx_dq: Lanes = each(|i| (-4.0 * q[i] * root[i] * stretch(i)).min(-SMALLEST_SLOPE));
        let by_q: Lanes = each(|i| {
            let [_, c1, c2, c3] = cubic[i];
            last * (c1 + t[i] * (2.0 * c2 + t[i] * (3.0 * c3)))
        });
        let logarithm: Lanes = each(|i| weight * ln[i] + (1.0 + weight * d[i]) / d[i]);
        let residual: Lanes = each(|i| by_q[i] / dx_dq[i]);
        let chain: Lanes = each(|i| match BELOW {
            true => (d[i] + scale * x[i]) * (d[i] + scale * x[i]) / scale,
            false => 1.0,
        });
        let slope: Lanes = each(|i| {
            let slope = (residual[i] + logarithm[i]) * chain[i];
            if captured(i) { f64::NAN } else { slope }
        });
        [bend, slope]
    }

    /// The row coordinates X and 1 − X.
    #[inline(always)]
    fn row_coordinates<const BELOW: bool>(&self, at: &[ShadowCoordinate; LANES]) -> [Lanes; 2] {
        let [x, d]: [Lanes; 2] = [each(|i| at[i].x), each(|i| at[i].one_minus_x)];
        if !BELOW {
            return [x, d];
        }
        let scaled: Lanes = each(|i| self.edge_scale * d[i]);
        let sum: Lanes = each(|i| x[i] + scaled[i]);
        [each(|i| x[i] / sum[i]), each(|i| scaled[i] / sum[i])]
    }

    /// The cubic whose number is in the lowest bits of a number that was rounded by [`ROUNDING`].
    #[inline(always)]
    fn cubic(&self, bits: u64) -> [f64; 4] {
        let interval = (bits & 0xffff_ffff) as usize;
        self.cubics[interval.min(self.cubics.len() - 1)]
    }

    fn is_below(&self) -> bool {
        self.row.axis() == Axis::ResidualBelow
    }
}

/// Position along the row, from the root of the row coordinate, √X, and `d` = 1 − X: [`Axis::position`].
#[inline(always)]
fn position<const BELOW: bool>(root: f64, d: f64) -> f64 {
    let rest = d / (1.0 + root);
    if !BELOW {
        return rest.sqrt();
    }
    let discriminant = (1.0 - STRETCH) * (1.0 - STRETCH) + 4.0 * STRETCH * root;
    (2.0 * rest / (1.0 + STRETCH + discriminant.sqrt())).sqrt()
}

/// The coordinate in the place of missing rays.
const ANY: ShadowCoordinate = ShadowCoordinate {
    x: 0.5,
    one_minus_x: 0.5,
};

/// What is written for a captured ray.
const CAPTURED: BendAndSlope = BendAndSlope {
    bend: f64::NAN,
    slope: f64::NAN,
};

/// The bending of rays at and below (`BELOW`) or above the horizon.
struct OneSide<'a, const BELOW: bool>(&'a RowBatch<'a>);

impl<const BELOW: bool> Batched<ShadowCoordinate, f64, LANES> for OneSide<'_, BELOW> {
    #[inline(always)]
    fn of(&self, at: &[ShadowCoordinate; LANES]) -> Lanes {
        let [bend, _] = self.0.look_up::<BELOW>(at);
        bend
    }
}

impl<const BELOW: bool> Batched<ShadowCoordinate, BendAndSlope, LANES> for OneSide<'_, BELOW> {
    #[inline(always)]
    fn of(&self, at: &[ShadowCoordinate; LANES]) -> [BendAndSlope; LANES] {
        let [bend, slope] = self.0.look_up::<BELOW>(at);
        each(|i| BendAndSlope {
            bend: bend[i],
            slope: slope[i],
        })
    }
}

/// The lookup of the rays `at` on the residual axis.
struct Lookup<'a, T> {
    batch: &'a RowBatch<'a>,
    at: &'a [ShadowCoordinate],
    results: &'a mut [T],
}

impl<T: Copy> NullaryFnOnce for Lookup<'_, T>
where
    for<'a> OneSide<'a, true>: Batched<ShadowCoordinate, T, LANES>,
    for<'a> OneSide<'a, false>: Batched<ShadowCoordinate, T, LANES>,
{
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Lookup { batch, at, results } = self;
        match batch.is_below() {
            true => in_lanes(OneSide::<true>(batch), at, ANY, results),
            false => in_lanes(OneSide::<false>(batch), at, ANY, results),
        }
    }
}

#[cfg(test)]
mod tests;
