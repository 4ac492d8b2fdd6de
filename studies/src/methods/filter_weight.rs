//! The weights of a GPU's texture sampler.

/// `weight`, from 0 to 1, rounded to 8 bits, the precision that GPU samplers have (Vulkan 1.3,
/// `subTexelPrecisionBits`).
pub(super) fn filter_weight(weight: f64) -> f64 {
    // For numbers ≥ 0 this is `round`, which is slow without SSE 4.1.
    f64::from((weight * 256.0 + 0.5) as u16) / 256.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_rounded_to_the_nearest() {
        for i in 0..=10_000 {
            let weight = f64::from(i) / 10_000.0;
            let rounded = (weight * 256.0).round() / 256.0;
            assert_eq!(filter_weight(weight), rounded, "{weight}");
        }
    }
}
