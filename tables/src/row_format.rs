//! The formats that the texels of a row are stored in on a GPU.

use crate::interpolation::cubic_coefficients;
use crate::{Interpolation, Texel};
use half::f16;

/// How the texels of a row are stored on a GPU. The default is exact to f32; the others are for studies of what a
/// smaller or a faster row costs in accuracy (`docs/gpu-chart.md`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum RowFormat {
    /// Value and slope as 32-bit floats.
    #[default]
    Float32,
    /// Value and slope as 16-bit floats.
    Float16,
    /// Value and slope as 16-bit integers, each mapped linearly from its range. The ranges are part of the shader.
    /// Textures of this format are an optional feature of a device.
    Unorm16(ChannelRanges),
    /// The four coefficients of the polynomial between a texel and the next, as 32-bit floats: one load per lookup in
    /// place of two, of twice the bytes.
    Coefficients,
}

impl RowFormat {
    /// Bytes of a texel that is read with `interpolation`.
    pub fn texel_bytes(self, interpolation: Interpolation) -> usize {
        let channels = interpolation.channels();
        match self {
            RowFormat::Float32 => channels * size_of::<f32>(),
            RowFormat::Float16 | RowFormat::Unorm16(_) => channels * size_of::<u16>(),
            RowFormat::Coefficients => size_of::<[f32; 4]>(),
        }
    }

    /// `texel` as it is read back from this format.
    pub(crate) fn rounded(self, texel: Texel) -> Texel {
        match self {
            RowFormat::Float32 | RowFormat::Coefficients => texel,
            RowFormat::Float16 => texel.map(|x| f16::from_f32(x).to_f32()),
            RowFormat::Unorm16(ranges) => ranges.decoded(ranges.encoded(texel)),
        }
    }

    /// The bytes of `texels` that are read with `interpolation`.
    pub(crate) fn bytes(self, texels: &[Texel], interpolation: Interpolation) -> Vec<u8> {
        let channels = interpolation.channels();
        match self {
            RowFormat::Float32 => {
                let numbers = texels.iter().flat_map(|texel| &texel[..channels]);
                numbers.flat_map(|x| x.to_le_bytes()).collect()
            }
            RowFormat::Float16 => {
                let numbers = texels.iter().flat_map(|texel| &texel[..channels]);
                let halves = numbers.map(|&x| f16::from_f32(x));
                halves.flat_map(|x| x.to_le_bytes()).collect()
            }
            RowFormat::Unorm16(ranges) => {
                let codes = texels.iter().map(|&texel| ranges.encoded(texel));
                let codes = codes.flat_map(|codes| codes.into_iter().take(channels));
                codes.flat_map(u16::to_le_bytes).collect()
            }
            RowFormat::Coefficients => {
                let after = (0..texels.len()).map(|i| coefficients(texels, i, interpolation));
                after.flatten().flat_map(f32::to_le_bytes).collect()
            }
        }
    }

    /// WGSL source that loads the texel `i` at the texture coordinates `texel` of the texture `row`, and that
    /// interpolates between two texels.
    pub(crate) fn wgsl(self, texel: &str, interpolation: Interpolation) -> String {
        let load = format!("textureLoad(row, {texel}, 0)");
        let read = match self {
            RowFormat::Float32 | RowFormat::Float16 | RowFormat::Coefficients => {
                format!("{load}.xy")
            }
            RowFormat::Unorm16(ranges) => ranges.wgsl(&format!("{load}.xy")),
        };
        let interpolated = match self {
            // lookup.wgsl has no function for coefficients, so that it is the same for all formats.
            RowFormat::Coefficients => format!(
                "\n    let i = min(u32(position), ROW_LAST);\n    \
                 let c = {load};\n    \
                 let t = position - f32(i);\n    \
                 return vec2(c.x + t * (c.y + t * (c.z + t * c.w)), c.y + t * (2.0 * c.z + t * 3.0 * c.w));\n"
            ),
            _ => format!(" return {}(position); ", interpolation.wgsl_function()),
        };
        format!(
            "fn row_texel(i: u32) -> vec2<f32> {{ return {read}; }}\n\
             fn interpolate(position: f32) -> vec2<f32> {{{interpolated}}}\n"
        )
    }
}

/// The coefficients of the polynomial after texel `i`, which must exist; after the last texel, its tangent.
pub(crate) fn coefficients(texels: &[Texel], i: usize, interpolation: Interpolation) -> [f32; 4] {
    let [value, slope] = texels[i];
    match (texels.get(i + 1), interpolation) {
        (None, _) => [value, slope, 0.0, 0.0],
        (Some(next), Interpolation::Linear) => [value, next[0] - value, 0.0, 0.0],
        (Some(&next), Interpolation::Hermite) => cubic_coefficients(texels[i], next),
    }
}

/// The ranges of the values and of the slopes that the codes 0 … 65535 of 16-bit integers stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ChannelRanges {
    // The bits of f32: a shader is specialised for them, so they are compared and hashed.
    least: [u32; 2],
    extent: [u32; 2],
}

impl ChannelRanges {
    /// The smallest ranges that hold `texels`. Rows with the same ranges share a shader; numbers outside are
    /// clamped.
    pub fn of(texels: &[Texel]) -> Self {
        let channel = |channel: usize| {
            let numbers = texels.iter().map(|texel| texel[channel]);
            let least = numbers.clone().reduce(f32::min).unwrap_or(0.0);
            let most = numbers.reduce(f32::max).unwrap_or(0.0);
            [least, (most - least).min(f32::MAX)]
        };
        let [[value, values], [slope, slopes]] = [channel(0), channel(1)];
        ChannelRanges {
            least: [value, slope].map(f32::to_bits),
            extent: [values, slopes].map(f32::to_bits),
        }
    }

    /// What the code 0 stands for, rad.
    pub fn least(self) -> [f32; 2] {
        self.least.map(f32::from_bits)
    }

    /// What the code 65535 stands for, less [`ChannelRanges::least`], rad.
    pub fn extent(self) -> [f32; 2] {
        self.extent.map(f32::from_bits)
    }

    /// The codes of the value and the slope of `texel`.
    pub fn encoded(self, texel: Texel) -> [u16; 2] {
        let (least, extent) = (self.least(), self.extent());
        std::array::from_fn(|i| {
            let part = (f64::from(texel[i]) - f64::from(least[i])) / f64::from(extent[i]);
            (part * f64::from(u16::MAX)).round() as u16
        })
    }

    /// The texel that the codes stand for, as a GPU computes it.
    pub fn decoded(self, codes: [u16; 2]) -> Texel {
        let (least, extent) = (self.least(), self.extent());
        std::array::from_fn(|i| {
            let part = f32::from(codes[i]) / f32::from(u16::MAX);
            least[i] + extent[i] * part
        })
    }

    /// WGSL expression of the texel, from that of its codes divided by 65535.
    fn wgsl(self, codes: &str) -> String {
        let ([value, slope], [values, slopes]) = (self.least(), self.extent());
        format!("vec2({value:?}, {slope:?}) + vec2({values:?}, {slopes:?}) * {codes}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpolation::{cubic, horner};

    fn texels() -> Vec<Texel> {
        (0..20)
            .map(|i| i as f32 / 19.0)
            .map(|t| [t * t - 0.4, 1e-2 * t.cos()])
            .collect()
    }

    #[test]
    fn every_format_reads_back_what_it_rounds() {
        let ranges = ChannelRanges::of(&texels());
        for (format, value_off, slope_off) in [
            (RowFormat::Float32, 0.0, 0.0),
            (RowFormat::Float16, 3e-4, 5e-6),
            (
                RowFormat::Unorm16(ranges),
                0.51 / 65535.0,
                0.26e-2 / 65535.0,
            ),
            (RowFormat::Coefficients, 0.0, 0.0),
        ] {
            for texel in texels() {
                let [value, slope] = format.rounded(texel);
                assert!((value - texel[0]).abs() <= value_off, "{format:?}");
                assert!((slope - texel[1]).abs() <= slope_off, "{format:?}");
            }
            for interpolation in [Interpolation::Linear, Interpolation::Hermite] {
                let bytes = format.bytes(&texels(), interpolation).len();
                assert_eq!(bytes, 20 * format.texel_bytes(interpolation));
            }
        }
    }

    #[test]
    fn the_ends_of_a_range_are_the_least_and_the_largest_code() {
        let ranges = ChannelRanges::of(&[[1.0, 7.0], [3.0, 7.0]]);
        assert_eq!(ranges.encoded([1.0, 7.0]), [0, 0]);
        assert_eq!(ranges.encoded([3.0, 7.0]), [65535, 0]);
        assert_eq!(ranges.encoded([9.0, 7.0]), [65535, 0]);
        assert_eq!(ranges.decoded([65535, 0]), [3.0, 7.0]);
    }

    #[test]
    fn the_polynomial_of_the_coefficients_is_the_interpolation() {
        let texels = texels();
        let after = |i| coefficients(&texels, i, Interpolation::Hermite);
        for (i, ends) in texels.windows(2).enumerate() {
            assert_eq!(horner(after(i), 0.3), cubic(ends[0], ends[1], 0.3));
        }
        assert_eq!(horner(after(19), 0.0), texels[19]);
    }
}
