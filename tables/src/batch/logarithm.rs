//! The natural logarithm without branches, for loops over lanes.
//!
//! The argument is 2^k m with m from √½ to √2. In f64, ln m is the odd series in (m−1)/(m+1) with the coefficients of
//! Sun's fdlibm: the error is below one unit in the last place. In f32 it is the polynomial in m − 1 of Moshier's Cephes,
//! to 1.2e-7 relative to ln m.

/// ln 2 in two parts, of which the first has 21 zeros at its end, so that k times it is exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];
/// The same in f32, with 12 zeros.
pub(super) const LN_2_F32: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];

/// The logarithm of a positive number; any number for others.
#[inline(always)]
pub(super) fn ln(x: f64) -> f64 {
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    // 2^52 + 1023, in whose lowest bits an exponent fits.
    const EXPONENT: u64 = 0x4330_0000_0000_0000;
    const BIAS: f64 = 4_503_599_627_370_496.0 + 1023.0;
    let is_subnormal = x < f64::MIN_POSITIVE;
    let scaled = if is_subnormal {
        x * (1_u64 << 54) as f64
    } else {
        x
    };
    let bits = scaled.to_bits();
    let exponent = bits.wrapping_add(ONE - SQRT_HALF) >> 52;
    let m = f64::from_bits(bits.wrapping_sub(exponent << 52).wrapping_add(ONE));
    let k = f64::from_bits(exponent | EXPONENT) - BIAS;
    let k = if is_subnormal { k - 54.0 } else { k };
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let (z, w) = (s * s, s * s * (s * s));
    let even = w
        * (0.399_999_999_994_094_2 + w * (0.222_221_984_321_497_84 + w * 0.153_138_376_992_093_73));
    let odd = z
        * (0.666_666_666_666_673_5
            + w * (0.285_714_287_436_623_9
                + w * (0.181_835_721_616_180_5 + w * 0.147_981_986_051_165_86)));
    let half_square = 0.5 * f * f;
    k * LN_2[0] - ((half_square - (s * (half_square + even + odd) + k * LN_2[1])) - f)
}

/// k and ln m of a positive number in f32; any numbers for others.
#[inline(always)]
pub(super) fn ln_parts(x: f32) -> [f32; 2] {
    const ONE: u32 = 0x3f80_0000;
    const SQRT_HALF: u32 = 0x3f35_04f3;
    let is_subnormal = x < f32::MIN_POSITIVE;
    let scaled = if is_subnormal {
        x * (1_u32 << 25) as f32
    } else {
        x
    };
    let bits = scaled.to_bits();
    let exponent = bits.wrapping_add(ONE - SQRT_HALF) >> 23;
    let m = f32::from_bits(bits.wrapping_sub(exponent << 23).wrapping_add(ONE));
    let k = (exponent.cast_signed() - 127) as f32;
    let k = if is_subnormal { k - 25.0 } else { k };
    let f = m - 1.0;
    let mut series = 7.037_683_6e-2;
    for coefficient in [
        -1.151_461e-1,
        1.167_699_9e-1,
        -1.242_014_1e-1,
        1.424_932_3e-1,
        -1.666_805_8e-1,
        2.000_071_5e-1,
        -2.499_999_4e-1,
        3.333_333e-1,
    ] {
        series = series * f + coefficient;
    }
    [k, f + f * f * (f * series - 0.5)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_logarithm_is_good_to_a_unit_in_the_last_place(exponent in -1074.0..1023.0, near in -1e-3..1e-3) {
            for x in [f64::exp2(exponent), 1.0 + near, f64::sqrt(2.0) * (1.0 + near)] {
                let exact = x.ln();
                prop_assert!((ln(x) - exact).abs() <= 1.5 * f64::EPSILON * exact.abs(), "{x:e}: {} {exact}", ln(x));
            }
        }

        #[test]
        fn the_logarithm_in_single_precision_is_as_good_as_stated(exponent in -149.0..127.0f32, near in -0.4..0.4f32) {
            for x in [exponent.exp2(), 1.0 + near] {
                let [k, ln_m] = ln_parts(x);
                let found = f64::from(k) * std::f64::consts::LN_2 + f64::from(ln_m);
                let exact = f64::from(x).ln();
                let ln_m = exact - f64::from(k) * std::f64::consts::LN_2;
                // The numbers compared are themselves rounded to f64.
                let rounding = 2.0 * f64::EPSILON * exact.abs();
                prop_assert!((found - exact).abs() <= 1.2e-7 * ln_m.abs() + rounding, "{x:e}: {found} {exact}");
            }
        }
    }

    #[test]
    fn the_parts_of_ln_2_are_its_own() {
        assert!((LN_2[0] + LN_2[1] - std::f64::consts::LN_2).abs() < 1e-16);
        let [high, low] = LN_2_F32.map(f64::from);
        assert!((high + low - std::f64::consts::LN_2).abs() < 1e-11);
        assert_eq!(LN_2[0].to_bits() % (1 << 21), 0);
        assert_eq!(LN_2_F32[0].to_bits() % (1 << 12), 0);
    }
}
