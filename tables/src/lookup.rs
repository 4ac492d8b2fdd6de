//! The lookup as a GPU does it, in f32, beside its WGSL text ([`WGSL`]): function for function the
//! same. The reference in f64 is [`crate::Row::bend`].

use crate::axis::log_weight;
use crate::{Interpolation, Row, Texel};
use lensbake_core::{Fate, Observer};

/// The same lookup for a GPU. Needs before it the text of [`wgsl_row`].
pub const WGSL: &str = concat!(include_str!("arithmetic.wgsl"), include_str!("lookup.wgsl"));

/// The part of [`WGSL`] that needs no row: `cubic`, `cos_sin` and `angle`.
pub const ARITHMETIC_WGSL: &str = include_str!("arithmetic.wgsl");

/// Texels across the texture of a row. WebGPU promises as many on every device, and a longer row goes on in
/// the next line.
pub const ROW_LINE: u32 = 8192;

/// Width and height of the texture that holds a row of `texels` texels. The texels lie line after line; the
/// rest of the last line is not read.
pub fn row_texture_size(texels: u32) -> [u32; 2] {
    [texels.min(ROW_LINE), texels.div_ceil(ROW_LINE)]
}

/// WGSL that declares the row of `texels` texels as a texture of [`row_texture_size`] at the given binding,
/// loads from it, and reads between two texels by `interpolation`: by hand, for hardware filters have 8-bit
/// weights.
pub fn wgsl_row(texels: u32, interpolation: Interpolation, group: u32, binding: u32) -> String {
    let place = if texels <= ROW_LINE {
        "vec2(i, 0u)".to_owned()
    } else {
        format!("vec2(i % {ROW_LINE}u, i / {ROW_LINE}u)")
    };
    format!(
        "const ROW_LAST: u32 = {}u;\n\
         @group({group}) @binding({binding}) var row: texture_2d<f32>;\n\
         fn row_texel(i: u32) -> vec2<f32> {{ return textureLoad(row, {place}, 0).xy; }}\n\
         fn interpolate(position: f32) -> vec2<f32> {{ return {}(position); }}\n",
        texels - 1,
        interpolation.wgsl_function(),
    )
}

/// The shadow's edge as the observer sees it; laid out as the WGSL struct is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct Edge {
    /// tan(θ_c/2).
    pub tan_half: f32,
    /// (5/18) cos θ_c, the weight of (1−x) ln(1−x) beside ln(1−x).
    pub log_weight: f32,
    /// dΔ/dx at x = 0, straight away from the hole.
    pub away_slope: f32,
}

/// sin θ and x below which a ray looks straight away from the hole: Δ is `away_slope`·x, to 1e-6 of itself.
pub const STRAIGHT_AWAY: f32 = 1e-3;

impl Edge {
    /// The edge that `observer` sees.
    pub fn of(observer: &Observer) -> Self {
        Edge {
            tan_half: observer.tan_half_edge() as f32,
            log_weight: log_weight(observer) as f32,
            away_slope: observer.bend_slope_away() as f32,
        }
    }
}

/// A row as a GPU holds it.
#[derive(Debug, Clone, PartialEq)]
pub struct GpuRow {
    /// The edge it is measured from.
    pub edge: Edge,
    /// The texels, array of shape `[texels]`.
    pub texels: Vec<Texel>,
    /// How they are read.
    pub interpolation: Interpolation,
}

/// The bending as a GPU finds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bending {
    /// Δ, rad.
    pub bend: f32,
    /// dΔ/dθ along the view angle.
    pub slope: f32,
}

/// x = tan(θ_c/2) / tan(θ/2) of a unit direction with cos θ = `c` and sin θ = `p` ≥ 0.
pub fn edge_coordinate(c: f32, p: f32, edge: Edge) -> f32 {
    let cot_half = if c >= 0.0 {
        (1.0 + c) / p.max(1e-30)
    } else {
        p / (1.0 - c)
    };
    edge.tan_half * cot_half
}

impl GpuRow {
    /// The row as it is uploaded. The shader knows the residual axis only.
    pub fn new(row: &Row) -> Self {
        GpuRow {
            edge: Edge::of(row.observer()),
            texels: row.gpu_texels(),
            interpolation: row.interpolation(),
        }
    }

    /// At `position` in texels, the value and its derivative a texel, as the row is to be read.
    pub fn interpolate(&self, position: f32) -> [f32; 2] {
        match self.interpolation {
            Interpolation::Linear => self.linear(position),
            Interpolation::Hermite => self.hermite(position),
        }
    }

    /// Linear at `position` in texels: the value and its derivative a texel. Reads the values only.
    pub fn linear(&self, position: f32) -> [f32; 2] {
        let i = (position as usize).min(self.texels.len() - 2);
        let a = self.texels[i][0];
        let rise = self.texels[i + 1][0] - a;
        [a + (position - i as f32) * rise, rise]
    }

    /// Cubic Hermite at `position` in texels: the value and its derivative a texel.
    pub fn hermite(&self, position: f32) -> [f32; 2] {
        let i = (position as usize).min(self.texels.len() - 2);
        cubic(self.texels[i], self.texels[i + 1], position - i as f32)
    }

    /// The bending in the direction with cos θ = `c` and sin θ = `p`.
    pub fn bending(&self, c: f32, p: f32) -> Fate<Bending> {
        let x = edge_coordinate(c, p, self.edge);
        if x >= 1.0 {
            return Fate::Captured;
        }
        if c < 0.0 && p.max(x) < STRAIGHT_AWAY {
            return Fate::Escapes(Bending {
                bend: self.edge.away_slope * x,
                slope: -self.edge.away_slope * self.edge.tan_half / (1.0 - c),
            });
        }
        let last = (self.texels.len() - 1) as f32;
        let d = 1.0 - x;
        let root = x.sqrt();
        let q = (d / (1.0 + root)).sqrt();
        let [value, slope] = self.interpolate(q * last);
        let ln = d.ln();
        let factor = 1.0 + self.edge.log_weight * d;
        let dx_dq = -4.0 * q * root.max(1e-9);
        let by_x = slope * last / dx_dq + self.edge.log_weight * ln + factor / d;
        Fate::Escapes(Bending {
            bend: value - factor * ln,
            slope: -by_x * x / p.max(1e-30),
        })
    }
}

/// The cubic that has the values and slopes of the texels `a` and `b` at t = 0 and 1: its value and its
/// derivative at `t`.
pub fn cubic([a, slope_a]: Texel, [b, slope_b]: Texel, t: f32) -> [f32; 2] {
    let rise = b - a;
    let c2 = 3.0 * rise - 2.0 * slope_a - slope_b;
    let c3 = slope_a + slope_b - 2.0 * rise;
    [
        a + t * (slope_a + t * (c2 + t * c3)),
        slope_a + t * (2.0 * c2 + t * 3.0 * c3),
    ]
}

/// (cos, sin) of an angle in rad, to 1e-7 up to 100 turns: Cody and Waite's reduction to a quarter
/// turn and the polynomials of Moshier's Cephes.
pub fn cos_sin(angle: f32) -> [f32; 2] {
    let quarter = (angle * std::f32::consts::FRAC_2_PI).round();
    let r = ((angle - quarter * 1.570_312_5) - quarter * 4.837_513e-4) - quarter * 7.549_79e-8;
    let r2 = r * r;
    let sine = r + r * r2 * (-1.666_665_4e-1 + r2 * (8.332_161e-3 + r2 * -1.951_529_6e-4));
    let cosine =
        1.0 - 0.5 * r2 + r2 * r2 * (4.166_664_6e-2 + r2 * (-1.388_731_6e-3 + r2 * 2.443_315_7e-5));
    match quarter as i32 & 3 {
        0 => [cosine, sine],
        1 => [-sine, cosine],
        2 => [-cosine, -sine],
        _ => [sine, -cosine],
    }
}

/// The angle in [0, π] whose cosine and sine are in the ratio of `c` to `p` ≥ 0, to 2e-7: the reduction
/// and the polynomial of Moshier's Cephes.
pub fn angle(c: f32, p: f32) -> f32 {
    use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    let a = c.abs();
    let (base, x) = if p > 2.414_213_5 * a {
        (FRAC_PI_2, -a / p)
    } else if p > 0.414_213_57 * a {
        (FRAC_PI_4, (p - a) / (p + a))
    } else {
        (0.0, p / a.max(1e-30))
    };
    let z = x * x;
    let terms = -3.333_295e-1 + z * (1.997_771_1e-1 + z * (-1.387_768_5e-1 + z * 8.053_744_6e-2));
    let first = base + (x + x * z * terms);
    if c < 0.0 { PI - first } else { first }
}

/// (cos θ′, sin θ′) of the direction turned towards the hole, θ′ = θ − Δ.
pub fn turned(c: f32, p: f32, bend: f32) -> [f32; 2] {
    let [cos, sin] = cos_sin(bend);
    [c * cos + p * sin, p * cos - c * sin]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cos_sin_is_good_to_a_few_ulp() {
        for i in -20_000..20_000 {
            let angle = i as f32 * 1e-3;
            let [cos, sin] = cos_sin(angle);
            let (exact_sin, exact_cos) = f64::from(angle).sin_cos();
            assert!((f64::from(cos) - exact_cos).abs() < 1.5e-7, "cos {angle}");
            assert!((f64::from(sin) - exact_sin).abs() < 1.5e-7, "sin {angle}");
        }
    }

    #[test]
    fn angle_is_good_to_a_few_ulp() {
        for i in 0..=40_000 {
            let theta = std::f64::consts::PI * f64::from(i) / 40_000.0;
            let (c, p) = (theta.cos() as f32, theta.sin().max(0.0) as f32);
            let exact = f64::from(p).atan2(c.into());
            let off = (f64::from(angle(c, p)) - exact).abs();
            assert!(off < 3e-7, "{theta}: {off:e}");
        }
    }

    #[test]
    fn a_row_of_any_length_fits_into_its_texture() {
        for texels in [4, 64, ROW_LINE, ROW_LINE + 1, 1 << 16] {
            crate::header::check_texels(texels).unwrap();
            let [width, height] = row_texture_size(texels);
            assert!(width <= ROW_LINE && height <= ROW_LINE);
            assert!(width * height >= texels && width * (height - 1) < texels);
        }
    }

    #[test]
    fn turning_by_nothing_changes_nothing() {
        assert_eq!(turned(0.6, 0.8, 0.0), [0.6, 0.8]);
    }
}
