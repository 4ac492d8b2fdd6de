//! The row as the renderer looks it up: the map from the stereographic coordinate of a view direction to that of the
//! direction on the sky.
//!
//! In the plane of a ray a direction at the angle θ from that of the hole has the stereographic coordinate tan(θ/2).
//! The row coordinate X is already a linear fractional function of the one that is seen: x = tan(θ_c/2) cot(θ/2) above the
//! horizon. The one on the sky, tan(θ′/2), is tabulated as a linear fractional function of X in each of [`ARCS`] ×
//! [`OCTAVES`] intervals at either end of the axis,
//!
//! ```text
//! tan(θ′/2) = B/A,     (A, B) = texel.xy + texel.zw t,     cos θ′ : sin θ′ = A² − B² : 2 A B
//! ```
//!
//! with t the distance from the interval's lower end. So the lookup needs no logarithm, sine or cosine: it is one texel
//! and a few products. Near either end, v = X or v = 1 − X, the intervals are those of a floating-point number: its exponent
//! and the first bits of its mantissa are the index. They are fine at the shadow's edge, where Δ = −ln(1−X) turns as much in
//! each octave, and at the direction away from the hole, where the layer of a distant observer is narrow.
//!
//! Without bending θ′ = θ, which is linear fractional and so exact. With bending the error of φ = θ′/2 is of third order,
//! at most S φ′ h³ √3/216, where h is the width of an interval, and S = {φ, v} + 2 φ′² the Schwarzian derivative of tan φ,
//! which is 0 for a linear fractional function. At the edge φ = −(1/2) ln v, so that S = 1/v², and the error of θ′ is at most
//! 0.008 (h/v)³ = 3.1e-8 rad.
//!
//! θ′ as a function of X does not depend on the motion of an observer along the radius; only X as a function of θ does.

mod arcs;

use crate::Row;
use crate::lookup::{HorizonSide, ShadowEdge};
use crate::mirror::{by_view_angle, row_coordinate};
use lensbake_core::RayOutcome;

/// WGSL source of the lookup above the horizon. The text of [`StereographicRow::wgsl`] must precede it.
pub const WGSL: &str = concat!(
    include_str!("../wgsl/shadow_edge.wgsl"),
    include_str!("../wgsl/row_coordinate_above.wgsl"),
    include_str!("../wgsl/stereographic.wgsl")
);

/// WGSL source of the lookup below the horizon: as [`WGSL`], with another row coordinate.
pub const WGSL_BELOW: &str = concat!(
    include_str!("../wgsl/shadow_edge.wgsl"),
    include_str!("../wgsl/row_coordinate_below.wgsl"),
    include_str!("../wgsl/stereographic.wgsl")
);

/// Intervals for each power of two of X and of 1 − X.
pub const ARCS: u32 = 64;
/// Powers of two at either end of the axis: from 2⁻²⁴, the smallest difference from 1 in f32, to 1/2.
pub const OCTAVES: u32 = 23;
/// Intervals at either end.
const INTERVALS: usize = (ARCS * OCTAVES) as usize;
/// The smallest X and 1 − X that have an index of their own. Smaller ones belong to the first interval, which begins at 0.
const SMALLEST: f32 = 1.0 / 16_777_216.0;
/// Bits of a mantissa in f32 that are not part of an index.
const FRACTION: u32 = 23 - ARCS.ilog2();
/// The exponent and the first bits of the mantissa of [`SMALLEST`]: the index is counted from here.
const FIRST: u32 = SMALLEST.to_bits() >> FRACTION;

/// Bytes of a row on a GPU: 46 KiB.
pub const BYTES: usize = 2 * INTERVALS * size_of::<[f32; 4]>();

/// A row in stereographic coordinates, as it is uploaded to a GPU.
#[derive(Debug, Clone, PartialEq)]
pub struct StereographicRow {
    /// The shadow boundary, from which the row coordinate is measured.
    pub edge: ShadowEdge,
    /// The side of the horizon that the observer is on.
    pub side: HorizonSide,
    /// (A, B) at the lower end of each interval, and their derivatives by X or 1 − X: first the intervals of X, then those
    /// of 1 − X; array of shape `[2 × OCTAVES × ARCS]`.
    pub texels: Vec<[f32; 4]>,
}

/// The direction on the sky as a GPU computes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkyDirection {
    /// (cos θ′, sin θ′) up to a factor.
    pub cos_sin: [f32; 2],
    /// dθ′/dθ, the derivative along the view angle.
    pub radial: f32,
}

impl StereographicRow {
    /// Width and height of the texture that holds a row: a line is an octave.
    pub const TEXTURE_SIZE: [u32; 2] = [ARCS, 2 * OCTAVES];

    /// `row`, which must be on the residual axis, in stereographic coordinates. Its directions are within 1.2e-7 rad of
    /// those of the row: 3.1e-8 rad for the intervals, the rest for the rounding of the texels to f32.
    pub fn new(row: &Row) -> Self {
        StereographicRow {
            edge: ShadowEdge::of(row.observer()),
            side: HorizonSide::of(row.observer()),
            texels: arcs::of(row),
        }
    }

    /// WGSL source that declares the row as a texture of [`StereographicRow::TEXTURE_SIZE`] at the given binding, and loads
    /// from it.
    pub fn wgsl(group: u32, binding: u32) -> String {
        format!(
            "const INTERVALS: u32 = {INTERVALS}u;\n\
             const FRACTION: u32 = {FRACTION}u;\n\
             const FIRST: u32 = {FIRST}u;\n\
             @group({group}) @binding({binding}) var row: texture_2d<f32>;\n\
             fn row_texel(i: u32) -> vec4<f32> {{ return textureLoad(row, vec2(i % {ARCS}u, i / {ARCS}u), 0); }}\n"
        )
    }

    /// The lookup for this row: [`WGSL`] or [`WGSL_BELOW`].
    pub fn lookup_wgsl(&self) -> &'static str {
        match self.side {
            HorizonSide::Above => WGSL,
            HorizonSide::Below => WGSL_BELOW,
        }
    }

    /// The bytes of the row's texture (`rgba32float`), line by line.
    pub fn texture_bytes(&self) -> Vec<u8> {
        let numbers = self.texels.iter().flatten();
        numbers.flat_map(|x| x.to_le_bytes()).collect()
    }

    /// The direction on the sky in which light comes that is seen in the direction (cos θ, sin θ) = (`c`, `p`)/√(c² + p²),
    /// where `p` ≥ 0: the mirror of the WGSL function. The vector (`c`, `p`) need not be normalised for
    /// [`SkyDirection::cos_sin`]; the derivative needs a unit vector.
    pub fn sky_direction(&self, c: f32, p: f32) -> RayOutcome<SkyDirection> {
        // Straight away from the hole, x/sin θ has a limit.
        let p = p.max(1e-30);
        let x = row_coordinate(c, p, self.edge, self.side);
        if x >= 1.0 {
            return RayOutcome::Captured;
        }
        let d = 1.0 - x;
        let beside_edge = x > d;
        let v = x.min(d);
        let last = FIRST + INTERVALS as u32 - 1;
        let bits = (v.to_bits() >> FRACTION).clamp(FIRST, last);
        let i = (bits - FIRST) as usize;
        // The first interval begins at 0.
        let start = if i == 0 {
            0.0
        } else {
            f32::from_bits(bits << FRACTION)
        };
        let first = if beside_edge { INTERVALS } else { 0 };
        let [a, b, slope_a, slope_b] = self.texels[first + i];
        let t = v - start;
        let (a, b) = (a + t * slope_a, b + t * slope_b);
        let by_v = 2.0 * (a * slope_b - b * slope_a) / (a * a + b * b);
        let by_x = if beside_edge { -by_v } else { by_v };
        RayOutcome::Escapes(SkyDirection {
            cos_sin: [(a - b) * (a + b), 2.0 * a * b],
            radial: by_view_angle(by_x, x, p, self.edge, self.side),
        })
    }
}

#[cfg(test)]
mod tests;
