//! The inverse row as a GPU reads it, in f32, beside its WGSL text ([`WGSL`]): function for function the
//! same. The reference in f64 is [`InverseRow::image`](super::InverseRow::image).

use super::{FIRST, INVERSE_TEXELS, InverseRow};
use crate::Texel;
use crate::lookup::{cos_sin, cubic};

/// The inverse row for a GPU. Needs before it the text of [`wgsl_row`] and
/// [`lookup::ARITHMETIC_WGSL`](crate::lookup::ARITHMETIC_WGSL), or the whole of the lookup's.
pub const WGSL: &str = include_str!("inverse.wgsl");

/// WGSL that declares the inverse row as a texture of one line at the given binding, and loads from it.
pub fn wgsl_row(group: u32, binding: u32) -> String {
    format!(
        "const INVERSE_LAST: u32 = {}u;\n\
         @group({group}) @binding({binding}) var inverse_row: texture_2d<f32>;\n\
         fn inverse_texel(i: u32) -> vec2<f32> {{ return textureLoad(inverse_row, vec2(i, 0u), 0).xy; }}\n",
        INVERSE_TEXELS - 1,
    )
}

/// What the texels are measured from and along; laid out as the WGSL struct `Inverse` is.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Inverse {
    /// θ_c, rad.
    pub edge: f32,
    /// ϑ = scale sinh v, rad.
    pub scale: f32,
    /// ϑ of the first texel, rad.
    pub first_angle: f32,
    /// v of the first texel.
    pub first: f32,
    /// Texels in one unit of v.
    pub texels_per_v: f32,
}

/// An inverse row as a GPU holds it.
#[derive(Debug, Clone, PartialEq)]
pub struct GpuInverseRow {
    /// What the texels are measured from and along.
    pub inverse: Inverse,
    /// The texels, array of shape `[texels]`: Λ and its slope a texel.
    pub texels: Vec<Texel>,
}

/// Where a point of the sky is seen, as a GPU finds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GpuImage {
    /// (cos θ, sin θ) of the direction in which it is seen.
    pub cos_sin: [f32; 2],
    /// dθ/dϑ.
    pub stretch: f32,
}

/// e^v of x = sinh v, to a few parts in 1e7.
pub fn exp_arsinh(x: f32) -> f32 {
    let size = x.abs();
    let grown = size + (size * size + 1.0).sqrt();
    if x < 0.0 { 1.0 / grown } else { grown }
}

impl GpuInverseRow {
    /// The inverse row as it is uploaded.
    pub fn new(row: &InverseRow) -> Self {
        GpuInverseRow {
            inverse: Inverse {
                edge: row.observer.edge_angle() as f32,
                scale: row.scale as f32,
                first_angle: FIRST as f32,
                first: row.first as f32,
                texels_per_v: (1.0 / row.per_texel) as f32,
            },
            texels: row
                .texels
                .iter()
                .map(|t| [t[0] as f32, t[1] as f32])
                .collect(),
        }
    }

    /// Where the light that comes from the unwrapped sky angle `sky_angle` ≤ π (rad) is seen.
    pub fn image(&self, sky_angle: f32) -> GpuImage {
        let inverse = self.inverse;
        let last = self.texels.len() - 1;
        let inside = sky_angle.max(inverse.first_angle);
        let u = inside / inverse.scale;
        let exp_v = exp_arsinh(u);
        let position =
            ((exp_v.ln() - inverse.first) * inverse.texels_per_v).clamp(0.0, last as f32);
        let i = (position as usize).min(last - 1);
        let [value, slope] = cubic(self.texels[i], self.texels[i + 1], position - i as f32);
        let offset = 0.5 * inverse.scale * exp_v * (value + (sky_angle - inside)).exp();
        GpuImage {
            cos_sin: cos_sin(inverse.edge + offset),
            stretch: offset * (1.0 + slope * inverse.texels_per_v)
                / (inverse.scale * (u * u + 1.0).sqrt()),
        }
    }
}

impl GpuImage {
    /// How many times brighter than without the hole a point with `p` = |sin ϑ| is seen at this image of
    /// ϑ = `sky_angle`: μ = sin θ dθ / (|sin ϑ| dϑ).
    pub fn magnification(&self, sky_angle: f32, p: f32) -> f32 {
        // Straight away both sines vanish; their ratio is dθ/dϑ to (π − ϑ)².
        let straight_away = sky_angle > 3.13;
        self.stretch
            * if straight_away {
                self.stretch
            } else {
                self.cos_sin[1].max(0.0) / p.max(1e-30)
            }
    }
}
