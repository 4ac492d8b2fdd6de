//! The formats in which the numbers of a table can be stored, and how they are written.

use half::f16;
use lensbake_tables::{ChannelRanges, Texel};

/// Format of a stored number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Precision {
    /// 32-bit floats.
    F32,
    /// 16-bit floats.
    F16,
    /// 16-bit integers, which a texture shows as numbers from 0 to 1. The text has the ranges of values and slopes.
    Unorm16,
}

/// Largest number of a 16-bit integer.
const UNORM_MAX: f32 = 65_535.0;

impl Precision {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F16 => "f16",
            Precision::Unorm16 => "unorm16",
        }
    }
}

/// Texels in a format.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers {
    /// The format.
    pub precision: Precision,
    /// The texels after rounding, as a program reads them.
    pub texels: Vec<Texel>,
    /// The numbers in the file or the text; integers from 0 to 65535 for [`Precision::Unorm16`].
    stored: Vec<Texel>,
    /// The ranges that the integers of [`Precision::Unorm16`] stand for.
    ranges: Option<ChannelRanges>,
}

impl Numbers {
    /// `texels` rounded to `precision`.
    pub fn new(texels: &[Texel], precision: Precision) -> Self {
        let ranges = (precision == Precision::Unorm16).then(|| ChannelRanges::of(texels));
        let half = |number: f32| f16::from_f32(number).to_f32();
        let stored = texels.iter().map(|&texel| match (precision, ranges) {
            (_, Some(ranges)) => ranges.encoded(texel).map(f32::from),
            (Precision::F16, None) => texel.map(half),
            (_, None) => texel,
        });
        let stored: Vec<Texel> = stored.collect();
        let texels = stored.iter().map(|&texel| match ranges {
            Some(ranges) => ranges.decoded(texel.map(|code| code as u16)),
            None => texel,
        });
        Numbers {
            precision,
            texels: texels.collect(),
            stored,
            ranges,
        }
    }

    /// Inserts into `text` the decoding of numbers that are read from a texture.
    pub fn decode_texture(&self, text: &str) -> String {
        self.decode(text, 1.0)
    }

    /// Inserts into `text` the decoding of numbers that are read from an array of [`Numbers::lines`].
    pub fn decode_array(&self, text: &str) -> String {
        self.decode(text, UNORM_MAX)
    }

    /// Replaces the markers `VALUE_SCALE` and `SLOPE_SCALE` in `text` by the offset and factor of [`ChannelRanges`], or by
    /// nothing for floats. `largest` is the number that 65535 is read as: 1 from a texture, 65535 from an array.
    fn decode(&self, text: &str, largest: f32) -> String {
        let scale = |i: usize| match self.ranges {
            Some(ranges) => {
                let (least, extent) = (ranges.least()[i], ranges.extent()[i] / largest);
                format!("{} + {} * ", float(least.into()), float(extent.into()))
            }
            None => String::new(),
        };
        text.replace("VALUE_SCALE ", &scale(0))
            .replace("SLOPE_SCALE ", &scale(1))
    }

    /// The stored values and slopes as decimal literals, eight a line, separated by commas. Each literal parses back to the
    /// stored number; `suffix` follows it.
    pub fn lines(&self, suffix: &str) -> String {
        let written: Vec<String> = self
            .stored
            .iter()
            .flatten()
            .map(|&number| match self.precision {
                Precision::F16 => half(number) + suffix,
                Precision::F32 | Precision::Unorm16 => float(f64::from(number)) + suffix,
            })
            .collect();
        let lines: Vec<String> = written
            .chunks(8)
            .map(|line| format!("    {}", line.join(", ")))
            .collect();
        lines.join(",\n")
    }

    /// The stored texels as bytes, little-endian: the values and slopes, or the values alone.
    pub fn bytes(&self, slopes: bool) -> Vec<u8> {
        let channels = if slopes { 2 } else { 1 };
        let numbers = self
            .stored
            .iter()
            .flat_map(|texel| texel[..channels].to_vec());
        match self.precision {
            Precision::F32 => numbers.flat_map(f32::to_le_bytes).collect(),
            Precision::F16 => numbers
                .flat_map(|number| f16::from_f32(number).to_le_bytes())
                .collect(),
            Precision::Unorm16 => numbers
                .flat_map(|number| (number as u16).to_le_bytes())
                .collect(),
        }
    }

    /// The same numbers with the rows, of `width` texels, in reverse order.
    pub fn last_row_first(&self, width: usize) -> Self {
        let reversed = |texels: &[Texel]| texels.chunks(width).rev().flatten().copied().collect();
        Numbers {
            texels: reversed(&self.texels),
            stored: reversed(&self.stored),
            ..*self
        }
    }

    /// The stored texels.
    pub fn stored(&self) -> &[Texel] {
        &self.stored
    }
}

/// `number` as the shortest decimal with a point that gives the same f32, in every language.
pub fn float(number: f64) -> String {
    let number = number as f32;
    let size = number.abs();
    if size == 0.0 {
        return "0.0".to_owned();
    }
    if !(1e-4..1e7).contains(&size) {
        let text = format!("{number:e}");
        return match text.split_once('e') {
            Some((mantissa, exponent)) if !mantissa.contains('.') => {
                format!("{mantissa}.0e{exponent}")
            }
            _ => text,
        };
    }
    let text = number.to_string();
    if text.contains('.') {
        text
    } else {
        text + ".0"
    }
}

/// `number` as the shortest decimal that gives the same half float.
fn half(number: f32) -> String {
    for digits in 0..8 {
        let text = format!("{number:.digits$e}");
        if let Ok(read) = text.parse::<f32>()
            && f16::from_f32(read) == f16::from_f32(number)
        {
            return float(f64::from(read));
        }
    }
    float(f64::from(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_are_written_so_that_they_are_read_again() {
        for number in [
            0.0,
            1.0,
            -3.25,
            1e-30,
            7.549_79e-8,
            65_535.0,
            3.4e38,
            0.1,
            -1.5e-5,
        ] {
            let text = float(number);
            assert_eq!(text.parse::<f32>().unwrap(), number as f32, "{text}");
            assert!(text.contains('.'), "{text}");
        }
        for bits in (0..0x7c00).step_by(7) {
            let number = f16::from_bits(bits);
            let text = half(number.to_f32());
            assert_eq!(f16::from_f32(text.parse().unwrap()), number, "{text}");
        }
    }

    #[test]
    fn rows_are_reversed_and_their_texels_are_not() {
        let numbers = Numbers::new(
            &[[1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 0.0]],
            Precision::F32,
        );
        let values: Vec<f32> = numbers
            .last_row_first(2)
            .stored
            .iter()
            .map(|texel| texel[0])
            .collect();
        assert_eq!(values, [3.0, 4.0, 1.0, 2.0]);
    }

    #[test]
    fn integers_cover_the_range_of_the_numbers() {
        let texels = [[1.0, -2.0], [3.0, 5.0], [2.0, 0.0]];
        let numbers = Numbers::new(&texels, Precision::Unorm16);
        assert_eq!(numbers.stored()[0], [0.0, 0.0]);
        assert_eq!(numbers.stored()[1], [65_535.0; 2]);
        for (read, written) in numbers.texels.iter().zip(texels) {
            assert!((read[0] - written[0]).abs() < 2e-5 && (read[1] - written[1]).abs() < 6e-5);
        }
    }
}
