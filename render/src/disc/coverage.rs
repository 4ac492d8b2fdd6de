//! The share of a square patch that lies on one side of an edge.

use std::f64::consts::PI;

/// The share of a square patch of side 1 in which a linear function is positive that has the value `value` at the centre
/// and changes by `right` and `down` across the patch: exact. A step if it does not change.
pub(crate) fn positive_share(value: f64, right: f64, down: f64) -> f64 {
    let (long, short) = (right.abs().max(down.abs()), right.abs().min(down.abs()));
    let size = value.abs();
    // The distance at which the edge touches the first, and the last corner.
    let (flat, reach) = (0.5 * (long - short), 0.5 * (long + short));
    let larger = if size >= reach {
        1.0
    } else if size <= flat {
        0.5 + size / long
    } else {
        1.0 - (reach - size) * (reach - size) / (2.0 * long * short)
    };
    if value >= 0.0 { larger } else { 1.0 - larger }
}

/// The mean over an interval of phases of `width` around `middle` (rad) of a function with period π that is 1 from
/// `low` to `high` and 0 elsewhere; 0 ≤ low ≤ high ≤ π.
pub(crate) fn periodic_share(middle: f64, width: f64, low: f64, high: f64) -> f64 {
    let integral = |at: f64| {
        let turns = (at / PI).floor();
        turns * (high - low) + (at - turns * PI - low).clamp(0.0, high - low)
    };
    (integral(middle + 0.5 * width) - integral(middle - 0.5 * width)) / width
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_share_of_a_square_is_its_area(value in -1.0..1.0f64, right in -2.0..2.0f64, down in -2.0..2.0f64) {
            let n = 400;
            let even = |i: i32| (f64::from(i) + 0.5) / f64::from(n) - 0.5;
            let inside = (0..n * n).filter(|i| {
                value + right * even(i % n) + down * even(i / n) > 0.0
            });
            let counted = inside.count() as f64 / f64::from(n * n);
            prop_assert!((positive_share(value, right, down) - counted).abs() < 6e-3);
        }

        #[test]
        fn the_periodic_share_is_its_mean(middle in -4.0..4.0f64, width in 0.01..9.0f64, low in 0.0..1.0f64, size in 0.0..2.0f64) {
            let n = 4000;
            let inside = (0..n).filter(|i| {
                let at = middle + width * ((f64::from(*i) + 0.5) / f64::from(n) - 0.5);
                let at = at.rem_euclid(PI);
                at > low && at < low + size
            });
            let counted = inside.count() as f64 / f64::from(n);
            prop_assert!((periodic_share(middle, width, low, low + size) - counted).abs() < 2e-3);
        }
    }

    #[test]
    fn without_a_change_it_is_a_step() {
        assert_eq!(positive_share(1e-9, 0.0, 0.0), 1.0);
        assert_eq!(positive_share(-1e-9, 0.0, 0.0), 0.0);
        assert_eq!(positive_share(0.25, 0.0, 1.0), 0.75);
    }
}
