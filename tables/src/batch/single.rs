//! The lookup of many rays in f32: twice as many rays by one instruction.

use super::lanes::{Batched, each, in_lanes};
use super::logarithm::{LN_2_F32, ln_parts};
use super::{RowBatch, STRETCH};
use lensbake_core::ShadowCoordinate;
use pulp::{Arch, NullaryFnOnce};

/// Rays that are looked up together.
const LANES: usize = 16;

/// A number for each ray.
type Lanes = [f32; LANES];

/// 3 · 2²²: a sum with it is rounded to an integer, which is then in the lowest bits.
const ROUNDING: f32 = 12_582_912.0;

/// A row prepared for lookups of many rays in f32, made by [`Row::batch_f32`](crate::Row::batch_f32).
#[derive(Debug, Clone)]
pub struct RowBatchF32<'a> {
    batch: RowBatch<'a>,
    cubics: Vec<[f32; 4]>,
    log_weight: f32,
    edge_scale: f32,
}

impl<'a> RowBatchF32<'a> {
    pub(super) fn new(batch: RowBatch<'a>) -> Self {
        let cubics = batch.cubics.iter().map(|cubic| cubic.map(|c| c as f32));
        RowBatchF32 {
            cubics: cubics.collect(),
            log_weight: batch.log_weight as f32,
            edge_scale: batch.edge_scale as f32,
            batch,
        }
    }

    /// Writes the bending Δ at each value of 1 − x to `bends`, rad; NaN for a captured ray. If the lengths differ, the
    /// rest of the longer slice is left alone.
    ///
    /// Only 1 − x is given, because next to the edge of the shadow it cannot be computed from x or from the view angle in
    /// f32. Within 8e-7 rad of [`Row::bend`](crate::Row::bend) at the same 1 − x from 1e-6 above the horizon, and within 2e-6 rad
    /// down to r = 0.01; closer to the edge the bending is larger, and so is the spacing of f32.
    pub fn bend(&self, one_minus_x: &[f32], bends: &mut [f32]) {
        if self.batch.row.axis().is_residual() {
            Arch::new().dispatch(Lookup {
                batch: self,
                one_minus_x,
                bends,
            });
            return;
        }
        for (&d, bend) in one_minus_x.iter().zip(bends) {
            let one_minus_x = f64::from(d);
            let at = ShadowCoordinate {
                x: 1.0 - one_minus_x,
                one_minus_x,
            };
            let outcome = self.batch.row.bend(at).escaped();
            *bend = outcome.map_or(f32::NAN, |bend| bend as f32);
        }
    }

    #[inline(always)]
    fn look_up<const BELOW: bool>(&self, one_minus_x: &[f32; LANES]) -> Lanes {
        let [x, d] = self.row_coordinates::<BELOW>(one_minus_x);
        let root: Lanes = each(|i| x[i].sqrt());
        let q: Lanes = each(|i| position::<BELOW>(root[i], d[i]));
        let last = self.cubics.len() as f32;
        let texels: Lanes = each(|i| q[i].clamp(0.0, 1.0) * last);
        // At the last texel it is the last interval, and t is 1.
        let rounded: Lanes = each(|i| (texels[i] - 0.5 + ROUNDING).min(last - 1.0 + ROUNDING));
        let t: Lanes = each(|i| texels[i] - (rounded[i] - ROUNDING));
        let cubic: [[f32; 4]; LANES] = each(|i| self.cubic(rounded[i].to_bits()));
        let k: Lanes = each(|i| ln_parts(d[i])[0]);
        let ln_m: Lanes = each(|i| ln_parts(d[i])[1]);
        each(|i| {
            let ([c0, c1, c2, c3], k, ln_m) = (cubic[i], k[i], ln_m[i]);
            let value = c0 + t[i] * (c1 + t[i] * (c2 + t[i] * c3));
            let ln = k * std::f32::consts::LN_2 + ln_m;
            // The largest term comes last: it is exact, so that the sum is rounded once.
            let rest = value - self.log_weight * d[i] * ln - ln_m - k * LN_2_F32[1];
            let bend = rest - k * LN_2_F32[0];
            if one_minus_x[i] <= 0.0 {
                f32::NAN
            } else {
                bend
            }
        })
    }

    /// The row coordinates X and 1 − X.
    #[inline(always)]
    fn row_coordinates<const BELOW: bool>(&self, one_minus_x: &[f32; LANES]) -> [Lanes; 2] {
        let d = *one_minus_x;
        let x: Lanes = each(|i| 1.0 - d[i]);
        if !BELOW {
            return [x, d];
        }
        let scaled: Lanes = each(|i| self.edge_scale * d[i]);
        let sum: Lanes = each(|i| x[i] + scaled[i]);
        [each(|i| x[i] / sum[i]), each(|i| scaled[i] / sum[i])]
    }

    /// The cubic whose number is in the lowest bits of a number that was rounded by [`ROUNDING`].
    #[inline(always)]
    fn cubic(&self, bits: u32) -> [f32; 4] {
        let interval = (bits & 0x3f_ffff) as usize;
        self.cubics[interval.min(self.cubics.len() - 1)]
    }
}

/// Position along the row, as in f64.
#[inline(always)]
fn position<const BELOW: bool>(root: f32, d: f32) -> f32 {
    const E: f32 = STRETCH as f32;
    let rest = d / (1.0 + root);
    if !BELOW {
        return rest.sqrt();
    }
    let discriminant = (1.0 - E) * (1.0 - E) + 4.0 * E * root;
    (2.0 * rest / (1.0 + E + discriminant.sqrt())).sqrt()
}

/// The bending of rays at and below (`BELOW`) or above the horizon.
struct OneSide<'a, const BELOW: bool>(&'a RowBatchF32<'a>);

impl<const BELOW: bool> Batched<f32, f32, LANES> for OneSide<'_, BELOW> {
    #[inline(always)]
    fn of(&self, one_minus_x: &[f32; LANES]) -> Lanes {
        self.0.look_up::<BELOW>(one_minus_x)
    }
}

/// [`RowBatchF32::bend`] on the residual axis.
struct Lookup<'a> {
    batch: &'a RowBatchF32<'a>,
    one_minus_x: &'a [f32],
    bends: &'a mut [f32],
}

impl NullaryFnOnce for Lookup<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Lookup {
            batch,
            one_minus_x,
            bends,
        } = self;
        match batch.batch.is_below() {
            true => in_lanes(OneSide::<true>(batch), one_minus_x, 0.5, bends),
            false => in_lanes(OneSide::<false>(batch), one_minus_x, 0.5, bends),
        }
    }
}
