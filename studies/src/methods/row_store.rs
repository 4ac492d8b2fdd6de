//! The formats that the texels of a row are stored in.

use half::f16;

/// Storage format of the numbers of a texel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// 16-bit floats.
    F16,
    /// 16-bit integers; each channel is mapped linearly from its own range over the row to 0 … 65535.
    Unorm16,
    /// 32-bit floats.
    F32,
}

impl Format {
    /// All formats.
    pub const ALL: [Format; 3] = [Format::F16, Format::Unorm16, Format::F32];

    /// Name in the CSV files and the figures.
    pub fn name(self) -> &'static str {
        match self {
            Format::F16 => "f16",
            Format::Unorm16 => "unorm16",
            Format::F32 => "f32",
        }
    }
}

/// Texels that can be read, whatever their format.
pub(super) trait Texels {
    /// The `N` numbers of texel `i`; `N` must be the number of channels that the texels were stored with.
    fn texel<const N: usize>(&self, i: usize) -> [f64; N];
}

impl Texels for [f16] {
    fn texel<const N: usize>(&self, i: usize) -> [f64; N] {
        std::array::from_fn(|channel| self[N * i + channel].into())
    }
}

impl Texels for [f32] {
    fn texel<const N: usize>(&self, i: usize) -> [f64; N] {
        std::array::from_fn(|channel| self[N * i + channel].into())
    }
}

/// Codes per range of a channel.
const CODES: f64 = u16::MAX as f64;

/// The range of one channel over a row.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Range {
    least: f32,
    extent: f32,
}

impl Range {
    fn of(numbers: impl Iterator<Item = f64>) -> Self {
        let (least, most) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| {
            (least.min(x), most.max(x))
        });
        Range {
            least: least as f32,
            extent: (most - least) as f32,
        }
    }

    fn code(self, number: f64) -> u16 {
        let part = (number - f64::from(self.least)) / f64::from(self.extent);
        (part * CODES).round() as u16
    }

    fn number(self, code: u16) -> f64 {
        f64::from(self.least) + f64::from(self.extent) * (f64::from(code) * (1.0 / CODES))
    }
}

/// Texels of 16-bit integers, and the range of each channel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unorm16 {
    codes: Vec<u16>,
    ranges: Vec<Range>,
}

impl Unorm16 {
    fn new<const N: usize>(texels: &[[f64; N]]) -> Self {
        let channel = |channel| Range::of(texels.iter().map(move |texel| texel[channel]));
        let ranges: Vec<Range> = (0..N).map(channel).collect();
        let codes = texels.iter().flat_map(|texel| {
            let numbers = texel.iter().zip(&ranges);
            numbers.map(|(&number, range)| range.code(number))
        });
        Unorm16 {
            codes: codes.collect(),
            ranges,
        }
    }
}

impl Texels for Unorm16 {
    fn texel<const N: usize>(&self, i: usize) -> [f64; N] {
        std::array::from_fn(|channel| self.ranges[channel].number(self.codes[N * i + channel]))
    }
}

/// Texels in one of the formats.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Store {
    F16(Vec<f16>),
    Unorm16(Unorm16),
    F32(Vec<f32>),
}

impl Store {
    /// `texels` rounded to `format`.
    pub(super) fn new<const N: usize>(texels: &[[f64; N]], format: Format) -> Self {
        let numbers = texels.iter().flatten();
        match format {
            Format::F16 => Store::F16(numbers.map(|&x| f16::from_f64(x)).collect()),
            Format::Unorm16 => Store::Unorm16(Unorm16::new(texels)),
            Format::F32 => Store::F32(numbers.map(|&x| x as f32).collect()),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        match self {
            Store::F16(numbers) => size_of_val(numbers.as_slice()),
            Store::Unorm16(Unorm16 { codes, ranges }) => {
                size_of_val(codes.as_slice()) + size_of_val(ranges.as_slice())
            }
            Store::F32(numbers) => size_of_val(numbers.as_slice()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unorm16_is_off_by_half_a_step_of_each_channel() {
        let texels: Vec<[f64; 2]> = (0..100)
            .map(|i| f64::from(i) / 99.0)
            .map(|t| [3.0 - t * t, 1e-3 * t.sin()])
            .collect();
        let Store::Unorm16(stored) = Store::new(&texels, Format::Unorm16) else {
            panic!("another format")
        };
        for (i, texel) in texels.iter().enumerate() {
            let [value, slope] = stored.texel::<2>(i);
            assert!((value - texel[0]).abs() < 0.51 / 65535.0, "{i}");
            assert!((slope - texel[1]).abs() < 0.51e-3 / 65535.0, "{i}");
        }
        assert_eq!(Store::Unorm16(stored).bytes(), 100 * 2 * 2 + 2 * 2 * 4);
    }

    #[test]
    fn unorm16_of_a_constant_is_the_constant() {
        let Store::Unorm16(stored) = Store::new(&[[0.5]; 4], Format::Unorm16) else {
            panic!("another format")
        };
        assert_eq!(stored.texel::<1>(3), [0.5]);
    }
}
