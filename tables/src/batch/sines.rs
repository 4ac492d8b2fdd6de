//! Cosine and sine without branches, for loops over lanes.
//!
//! The angle is reduced to at most an eighth of a turn by Cody and Waite's method, with π/2 in two parts. The Taylor series
//! of the rest goes up to the power 17: the error is below 1e-15 for angles up to a hundred turns.

use super::ROUNDING;

/// π/2 in two parts, of which the first has 23 zeros at its end, so that small multiples of it are exact.
const QUARTER_TURN: [f64; 2] = [1.570_796_325_802_803, 9.920_935_796_805_404e-10];

/// (−1)ⁿ/(2n+1)! for n from 8 to 1.
const SINE: [f64; 8] = [
    2.811_457_254_345_520_6e-15,
    -7.647_163_731_819_816e-13,
    1.605_904_383_682_161_3e-10,
    -2.505_210_838_544_172e-8,
    2.755_731_922_398_589_3e-6,
    -1.984_126_984_126_984e-4,
    8.333_333_333_333_333e-3,
    -1.666_666_666_666_666_6e-1,
];
/// (−1)ⁿ/(2n)! for n from 8 to 1.
const COSINE: [f64; 8] = [
    4.779_477_332_387_385e-14,
    -1.147_074_559_772_972_5e-11,
    2.087_675_698_786_81e-9,
    -2.755_731_922_398_589e-7,
    2.480_158_730_158_73e-5,
    -1.388_888_888_888_889e-3,
    4.166_666_666_666_666_4e-2,
    -0.5,
];

/// Cosine and sine of an angle in rad.
#[inline(always)]
pub(crate) fn cos_sin(angle: f64) -> [f64; 2] {
    let rounded = angle * std::f64::consts::FRAC_2_PI + ROUNDING;
    let quarters = rounded - ROUNDING;
    let r = (angle - quarters * QUARTER_TURN[0]) - quarters * QUARTER_TURN[1];
    let r2 = r * r;
    let (mut sine, mut cosine) = (0.0, 0.0);
    for i in 0..SINE.len() {
        sine = (sine + SINE[i]) * r2;
        cosine = (cosine + COSINE[i]) * r2;
    }
    let (sine, cosine) = (r + r * sine, 1.0 + cosine);
    // The lowest bits count the quarter turns.
    let turn = rounded.to_bits();
    let (cos, sin) = if turn & 1 == 1 {
        (sine, cosine)
    } else {
        (cosine, sine)
    };
    [
        if (turn ^ (turn >> 1)) & 1 == 1 {
            -cos
        } else {
            cos
        },
        if turn & 2 == 2 { -sin } else { sin },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn cosine_and_sine_are_as_good_as_stated(angle in -600.0..600.0f64, quarters in -400..400, near in -1e-6..1e-6) {
            for angle in [angle, f64::from(quarters) * std::f64::consts::FRAC_PI_2 + near] {
                let [cos, sin] = cos_sin(angle);
                let (exact_sin, exact_cos) = angle.sin_cos();
                prop_assert!((cos - exact_cos).abs() < 1e-15, "{angle}: {cos} {exact_cos}");
                prop_assert!((sin - exact_sin).abs() < 1e-15, "{angle}: {sin} {exact_sin}");
            }
        }
    }

    #[test]
    fn the_parts_of_a_quarter_turn_are_its_own() {
        let [high, low] = QUARTER_TURN;
        assert_eq!(high + low, std::f64::consts::FRAC_PI_2);
        assert_eq!(high.to_bits() % (1 << 23), 0);
    }
}
