//! The inverse row on a GPU: its WGSL source ([`WGSL`]), the row as it is uploaded, and the mirrors of the WGSL
//! functions in f32. The reference in f64 is [`InverseRow::image`](super::InverseRow::image).

use super::{FIRST, INVERSE_TEXELS, InverseRow};
use crate::Texel;
use crate::interpolation::cubic;
use crate::mirror::cos_sin;

/// WGSL source of the lookup in an inverse row. It must be preceded by the text of [`wgsl_row`] and by the module
/// `arithmetic` of [`lookup::WGSL_MODULES`](crate::lookup::WGSL_MODULES), or the whole of
/// [`lookup::WGSL`](crate::lookup::WGSL).
pub const WGSL: &str = include_str!("../wgsl/inverse.wgsl");

/// WGSL source that declares the inverse row as a texture of one line at the given binding, and loads from it.
pub fn wgsl_row(group: u32, binding: u32) -> String {
    format!(
        "const INVERSE_LAST: u32 = {}u;\n\
         @group({group}) @binding({binding}) var inverse_row: texture_2d<f32>;\n\
         fn inverse_texel(i: u32) -> vec2<f32> {{ return textureLoad(inverse_row, vec2(i, 0u), 0).xy; }}\n",
        INVERSE_TEXELS - 1,
    )
}

/// Parameters of an inverse row: the view angle that its values are relative to, and its axis. In the layout of
/// the WGSL struct `Inverse`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Inverse {
    /// θ_c, rad.
    pub edge: f32,
    /// Centre of the axis in ϑ = centre + scale sinh v, rad.
    pub centre: f32,
    /// Scale of the axis, rad.
    pub scale: f32,
    /// ϑ of the first texel, rad.
    pub first_angle: f32,
    /// v of the first texel.
    pub first: f32,
    /// Texels per unit of v.
    pub texels_per_v: f32,
}

/// An inverse row in the form that is uploaded to a GPU.
#[derive(Debug, Clone, PartialEq)]
pub struct GpuInverseRow {
    /// Parameters of the inverse row.
    pub inverse: Inverse,
    /// The texels, array of shape `[texels]`: Λ and its slope per texel.
    pub texels: Vec<Texel>,
}

/// An image of a point of the sky, as a GPU computes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GpuImage {
    /// (cos θ, sin θ) of the direction in which the image is seen.
    pub cos_sin: [f32; 2],
    /// Radial magnification dθ/dϑ.
    pub radial_magnification: f32,
}

/// e^v as a function of x = sinh v, to a few parts in 1e7.
pub fn exp_arsinh(x: f32) -> f32 {
    let size = x.abs();
    let grown = size + (size * size + 1.0).sqrt();
    if x < 0.0 { 1.0 / grown } else { grown }
}

impl GpuInverseRow {
    /// `row` rounded to f32.
    pub fn new(row: &InverseRow) -> Self {
        GpuInverseRow {
            inverse: Inverse {
                edge: row.observer.shadow_angle() as f32,
                centre: row.centre as f32,
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

    /// The image for the unwrapped sky angle `sky_angle` ≤ π (rad): the direction in which light from there is
    /// seen.
    pub fn image(&self, sky_angle: f32) -> GpuImage {
        let inverse = self.inverse;
        let last = self.texels.len() - 1;
        let inside = sky_angle.max(inverse.first_angle);
        let u = (inside - inverse.centre) / inverse.scale;
        let exp_v = exp_arsinh(u);
        let position =
            ((exp_v.ln() - inverse.first) * inverse.texels_per_v).clamp(0.0, last as f32);
        let i = (position as usize).min(last - 1);
        let [value, slope] = cubic(self.texels[i], self.texels[i + 1], position - i as f32);
        let offset = 0.5 * inverse.scale * exp_v * (value + (sky_angle - inside)).exp();
        GpuImage {
            cos_sin: cos_sin(inverse.edge + offset),
            radial_magnification: offset * (1.0 + slope * inverse.texels_per_v)
                / (inverse.scale * (u * u + 1.0).sqrt()),
        }
    }
}

impl GpuImage {
    /// Magnification of a point source with `p` = |sin ϑ| at this image for ϑ = `sky_angle`, the ratio of its
    /// brightness to that without the hole: μ = sin θ dθ / (|sin ϑ| dϑ).
    pub fn magnification(&self, sky_angle: f32, p: f32) -> f32 {
        // Straight away from the hole both sines vanish; their ratio is dθ/dϑ up to terms of order (π − ϑ)².
        let straight_away = sky_angle > 3.13;
        self.radial_magnification
            * if straight_away {
                self.radial_magnification
            } else {
                self.cos_sin[1].max(0.0) / p.max(1e-30)
            }
    }
}
