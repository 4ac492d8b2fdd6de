//! The weights of a GPU's texture sampler.

/// Between 2^44 and 2^45 the numbers of type f64 are multiples of 1/256.
const MULTIPLES: f64 = (1_u64 << 44) as f64;

/// `weight`, from 0 to 1, rounded to 8 bits, the precision that GPU samplers have (Vulkan 1.3,
/// `subTexelPrecisionBits`); NaN stays NaN.
pub(super) fn filter_weight(weight: f64) -> f64 {
    // `round` calls a function on processors without SSE 4.1, which would take longer than the lookup.
    (weight + MULTIPLES) - MULTIPLES
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
