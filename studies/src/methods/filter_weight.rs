//! Linear filtering as a GPU's texture sampler does it, with weights of 8 bits.

use lensbake_tables::interpolation::chord;

/// Between 2^44 and 2^45 the numbers of type f64 are multiples of 1/256.
const MULTIPLES: f64 = (1_u64 << 44) as f64;

/// `weight`, from 0 to 1, rounded to 8 bits, the precision that GPU samplers have (Vulkan 1.3,
/// `subTexelPrecisionBits`); NaN stays NaN.
pub(super) fn filter_weight(weight: f64) -> f64 {
    // `round` calls a function on processors without SSE 4.1, which would take longer than the lookup.
    (weight + MULTIPLES) - MULTIPLES
}

/// The first of the two texels around `position` (in texels, from 0), of `count`, and the filter weight of the second.
#[inline]
pub fn texel_and_weight(position: f64, count: usize) -> (usize, f64) {
    let i = (position as usize).min(count - 2);
    (i, filter_weight(position - i as f64))
}

/// The bilinearly filtered value of the texture `value`, a function of column and row, between the texels of
/// [`texel_and_weight`] in both directions.
#[inline]
pub fn bilinear(
    value: impl Fn(usize, usize) -> f64,
    (column, across): (usize, f64),
    (row, between): (usize, f64),
) -> f64 {
    let texel = |column, row| [value(column, row), 0.0];
    let along = |row| chord(texel(column, row), texel(column + 1, row), across);
    chord(along(row), along(row + 1), between)[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_rounded_to_the_nearest() {
        for i in 0..=10_000 {
            let weight = f64::from(i) / 10_000.0;
            let rounded = (weight * 256.0).round_ties_even() / 256.0;
            assert_eq!(filter_weight(weight), rounded, "{weight}");
        }
        assert!(filter_weight(f64::NAN).is_nan());
    }
}
