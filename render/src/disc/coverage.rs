//! The share of a square patch that lies on one side of an edge.

use std::f64::consts::PI;

/// The share of a square patch of side 1 in which a linear function is positive that has the value `value` at the centre
/// and changes by `right` and `down` across the patch: exact. A step if it does not change.
pub(crate) fn positive_share(value: f64, right: f64, down: f64) -> f64 {
    let (long, short) = (right.abs().max(down.abs()), right.abs().min(down.abs()));
    let size = value.abs();
    // Within `flat` of the centre the edge crosses two opposite sides, up to `reach` it cuts off a triangle, and beyond it
    // misses the square.
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

/// Images of a disc that crowd together beside the edge of the shadow, in a patch that sees them at the distances
/// `middle` ± `half` from that edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crowded {
    /// Distance of the middle of the patch, > 0.
    pub middle: f64,
    /// Half the range of distances.
    pub half: f64,
    /// Phase at the middle at which the leg is in the plane of the disc, rad.
    pub phase: f64,
    /// −dφ/d ln distance: the phase grows like the logarithm of the distance.
    pub growth: f64,
}

/// Number of image orders that a patch may see; the next has e^−4π of its area.
const ORDERS: i32 = 4;

impl Crowded {
    /// The share of the patch in which the phase, up to half turns, is from `low` to `high`, 0 ≤ low ≤ high ≤ π, and the
    /// phase in the middle of the image that takes most of it.
    pub(crate) fn share(&self, low: f64, high: f64) -> (f64, f64) {
        let Crowded {
            middle,
            half,
            phase,
            growth,
        } = *self;
        let (first, last) = ((middle - half).max(0.0), middle + half);
        let at = |distance: f64| phase - growth * (distance / middle).ln();
        let distance = |at: f64| (middle * ((phase - at) / growth).exp()).clamp(first, last);
        let lowest = (at(last) / PI).floor();
        let (mut sum, mut largest, mut seen) = (0.0, 0.0, low);
        for order in 0..ORDERS {
            let turns = (lowest + f64::from(order)) * PI;
            let (near, far) = (distance(high + turns), distance(low + turns));
            sum += far - near;
            if far - near > largest {
                largest = far - near;
                seen = at(0.5 * (near + far)) - turns;
            }
        }
        (sum / (last - first), seen)
    }
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
        fn the_share_of_crowded_images_is_their_area(
            middle in 0.2..3.0f64, phase in 0.0..PI, growth in 0.8..1.2f64, low in 0.0..1.0f64, size in 0.1..2.0f64,
        ) {
            let crowded = Crowded { middle, half: 0.2, phase, growth };
            let n = 4000;
            let inside = (0..n).filter(|i| {
                let distance = middle + 0.4 * ((f64::from(*i) + 0.5) / f64::from(n) - 0.5);
                let at = (phase - growth * (distance / middle).ln()).rem_euclid(PI);
                at > low && at < low + size
            });
            let counted = inside.count() as f64 / f64::from(n);
            let (share, seen) = crowded.share(low, low + size);
            prop_assert!((share - counted).abs() < 2e-3, "{share} {counted}");
            prop_assert!(seen > low - 1e-9 && seen < low + size + 1e-9);
        }
    }

    #[test]
    fn without_a_change_it_is_a_step() {
        assert_eq!(positive_share(1e-9, 0.0, 0.0), 1.0);
        assert_eq!(positive_share(-1e-9, 0.0, 0.0), 0.0);
        assert_eq!(positive_share(0.25, 0.0, 1.0), 0.75);
    }
}
