//! The texels of a row in stereographic coordinates, from the direction on the sky and its derivative at the ends of the
//! intervals.
//!
//! A row is made for each frame in which the radius changes, so this is done by instructions for several numbers, as
//! lookups of many rays are (`batch`). What depends on the ends alone is computed once for all rows.

use super::{ARCS, INTERVALS, SMALLEST};
use crate::axis::SMALLEST_SLOPE;
use crate::batch::ROUNDING;
use crate::batch::lanes::each;
use crate::batch::sines::cos_sin;
use crate::lookup::{HorizonSide, ShadowEdge};
use crate::{Axis, Row};
use lensbake_core::ShadowCoordinate;
use pulp::{Arch, NullaryFnOnce};
use std::sync::LazyLock;

/// Ends or intervals that are computed together.
const LANES: usize = 8;
/// Numbers for that many ends or intervals.
type Lanes = [f64; LANES];
/// Nodes at each end of the axis: the ends of its intervals, and as many more as make the number a multiple of [`LANES`].
const NODES: usize = (INTERVALS + 1).next_multiple_of(LANES);

/// The places of the nodes of an axis, first those at X = 0, straight away from the hole, then those at X = 1, the shadow's
/// edge.
struct Places {
    /// X.
    x: Vec<f64>,
    /// d = 1 − X.
    d: Vec<f64>,
    /// The position q along the row.
    q: Vec<f64>,
    /// dq/dX.
    dq_dx: Vec<f64>,
    /// ln d.
    ln_d: Vec<f64>,
}

static ABOVE: LazyLock<Places> = LazyLock::new(|| Places::on(Axis::Residual));
static BELOW: LazyLock<Places> = LazyLock::new(|| Places::on(Axis::ResidualBelow));

/// The distance of node `k` from its end of the axis: X, or 1 − X. Interval k lies between the nodes k and k + 1.
pub(super) fn distance(k: usize) -> f64 {
    let (octave, part) = (k / ARCS as usize, k % ARCS as usize);
    f64::from(SMALLEST) * (1_u64 << octave) as f64 * (1.0 + part as f64 / f64::from(ARCS))
}

impl Places {
    fn on(axis: Axis) -> Self {
        let from_end = || (0..NODES).map(|k| distance(k.min(INTERVALS)));
        let away = from_end().map(|v| [v, 1.0 - v]);
        let edge = from_end().map(|v| [1.0 - v, v]);
        let (x, d): (Vec<f64>, Vec<f64>) = away.chain(edge).map(|[x, d]| (x, d)).unzip();
        let q: Vec<f64> = x
            .iter()
            .zip(&d)
            .map(|(&x, &one_minus_x)| axis.position(ShadowCoordinate { x, one_minus_x }))
            .collect();
        let dx_dq = q.iter().map(|&q| axis.coordinate_slope(q));
        Places {
            dq_dx: dx_dq
                .map(|slope| 1.0 / slope.min(-SMALLEST_SLOPE))
                .collect(),
            ln_d: d.iter().map(|d| d.ln()).collect(),
            q,
            x,
            d,
        }
    }
}

/// The texels of `row`: (A, B) at the lower end of each interval, and their derivatives; array of shape `[2 × INTERVALS]`.
pub(super) fn of(row: &Row) -> Vec<[f32; 4]> {
    let observer = row.observer();
    // As the lookup has them in f32: their rounding would turn all directions alike.
    let edge = ShadowEdge::of(observer);
    let curve = Curve {
        places: match HorizonSide::of(observer) {
            HorizonSide::Above => &ABOVE,
            HorizonSide::Below => &BELOW,
        },
        cubics: &row.cubics(),
        log_weight: row.axis().log_weight(observer),
        tan_half: edge.tan_half.into(),
        scale: edge.scale.into(),
    };
    let mut nodes = [(); 3].map(|()| vec![0.0; 2 * NODES]);
    let mut texels = vec![[0.0; 4]; 2 * INTERVALS];
    let [a, b, weight] = &mut nodes;
    Arch::new().dispatch(Tabulation {
        curve,
        a,
        b,
        weight,
        texels: &mut texels,
    });
    for first in [0, INTERVALS] {
        let [a, b, slope_a, slope_b] = &mut texels[first];
        // The first interval begins at 0.
        *a -= *slope_a * SMALLEST;
        *b -= *slope_b * SMALLEST;
    }
    // Straight away from the hole no ray turns: θ′ = π.
    texels[0][0] = 0.0;
    texels
}

/// φ = θ′/2 as a function of X.
struct Curve<'a> {
    places: &'a Places,
    cubics: &'a [[f64; 4]],
    log_weight: f64,
    /// tan(θ_c/2)/σ.
    tan_half: f64,
    /// σ.
    scale: f64,
}

impl Curve<'_> {
    /// cos φ, sin φ and √|dφ/dX| at the nodes `LANES * chunk ..`.
    #[inline(always)]
    fn nodes(&self, chunk: usize) -> [Lanes; 3] {
        let Places {
            x,
            d,
            q,
            dq_dx,
            ln_d,
        } = self.places;
        let [x, d, q, dq_dx, ln_d] =
            [x, d, q, dq_dx, ln_d].map(|numbers| numbers.as_chunks::<LANES>().0[chunk]);
        let last = self.cubics.len() as f64;
        let position: Lanes = each(|i| q[i] * last);
        // At the last texel it is the last interval, and t is 1.
        let rounded: Lanes = each(|i| (position[i] - 0.5 + ROUNDING).min(last - 1.0 + ROUNDING));
        let t: Lanes = each(|i| position[i] - (rounded[i] - ROUNDING));
        let cubic: [[f64; 4]; LANES] = each(|i| {
            let interval = (rounded[i].to_bits() & 0xffff_ffff) as usize;
            self.cubics[interval.min(self.cubics.len() - 1)]
        });
        let factor: Lanes = each(|i| 1.0 + self.log_weight * d[i]);
        let bend: Lanes = each(|i| {
            let [c0, c1, c2, c3] = cubic[i];
            c0 + t[i] * (c1 + t[i] * (c2 + t[i] * c3)) - factor[i] * ln_d[i]
        });
        let bend_slope: Lanes = each(|i| {
            let [_, c1, c2, c3] = cubic[i];
            let by_q = last * (c1 + t[i] * (2.0 * c2 + t[i] * (3.0 * c3)));
            by_q * dq_dx[i] + self.log_weight * ln_d[i] + factor[i] / d[i]
        });
        // tan(θ/2) = tan(θ_c/2)/x, with x = σX/(σX + d).
        let seen: Lanes = each(|i| self.tan_half * (self.scale * x[i] + d[i]));
        let turn: [[f64; 2]; LANES] = each(|i| cos_sin(0.5 * bend[i]));
        let size_sq: Lanes = each(|i| x[i] * x[i] + seen[i] * seen[i]);
        let size: Lanes = each(|i| 1.0 / size_sq[i].sqrt());
        // θ′/2 = θ/2 − Δ/2.
        let a: Lanes = each(|i| size[i] * (x[i] * turn[i][0] + seen[i] * turn[i][1]));
        let b: Lanes = each(|i| size[i] * (seen[i] * turn[i][0] - x[i] * turn[i][1]));
        let seen_slope: Lanes = each(|i| self.tan_half * size[i] * size[i]);
        let weight: Lanes = each(|i| (seen_slope[i] + 0.5 * bend_slope[i]).abs().sqrt());
        [a, b, weight]
    }
}

/// Writes the texels.
struct Tabulation<'a> {
    curve: Curve<'a>,
    a: &'a mut [f64],
    b: &'a mut [f64],
    weight: &'a mut [f64],
    texels: &'a mut [[f32; 4]],
}

impl NullaryFnOnce for Tabulation<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for chunk in 0..2 * NODES / LANES {
            let [a, b, weight] = self.curve.nodes(chunk);
            let place = chunk * LANES..(chunk + 1) * LANES;
            self.a[place.clone()].copy_from_slice(&a);
            self.b[place.clone()].copy_from_slice(&b);
            self.weight[place].copy_from_slice(&weight);
        }
        let (chunks, _) = self.texels.as_chunks_mut::<LANES>();
        for (chunk, texels) in chunks.iter_mut().enumerate() {
            // INTERVALS is a multiple of LANES.
            let interval = chunk * LANES % INTERVALS;
            let node = chunk * LANES / INTERVALS * NODES + interval;
            let per_width = 1.0 / (distance(interval + 1) - distance(interval));
            let ends = |numbers: &[f64]| -> [Lanes; 2] {
                [each(|i| numbers[node + i]), each(|i| numbers[node + i + 1])]
            };
            let ([a, next_a], [b, next_b], [weight, next_weight]) =
                (ends(self.a), ends(self.b), ends(self.weight));
            *texels = each(|i| {
                texel(
                    [a[i], b[i], weight[i]],
                    [next_a[i], next_b[i], next_weight[i]],
                    per_width,
                )
            });
        }
    }
}

/// The texel of an interval from (A, B) and √|dφ/dX| at both of its ends.
///
/// The texel describes the line from the unit vector at one end times w₀ to that at the other end times w₁. Along it, dφ/dt is
/// proportional to w₁/w₀ at the first end and to w₀/w₁ at the other, with the same factor. Their ratio is therefore that of
/// the derivatives if w₀² : w₁² = dφ/dX at the other end : dφ/dX at the first. The vector in the middle has nearly the length 1.
#[inline(always)]
fn texel(
    [a, b, weight]: [f64; 3],
    [next_a, next_b, next_weight]: [f64; 3],
    per_width: f64,
) -> [f32; 4] {
    let scale = 2.0 / (weight + next_weight);
    let (here, there) = (scale * next_weight, scale * weight);
    let (a, b) = (here * a, here * b);
    let slope_a = (there * next_a - a) * per_width;
    let slope_b = (there * next_b - b) * per_width;
    [a as f32, b as f32, slope_a as f32, slope_b as f32]
}
