//! A pattern of clouds on a disc, which turns with its matter.
//!
//! It is noise over (ln r, azimuth) in a frame that turns with the matter at each radius, Ω = √(1/2r³). Since the matter
//! nearer to the hole turns faster, such a pattern winds up without bound. So there are two layers of it, each of which
//! starts anew after every [`period`], half a period apart. A layer's weight is 0 when it starts and when it ends, and the
//! squares of both weights have the sum 1: the contrast stays the same. So the pattern is a function of time alone.
//!
//! An octave of the noise fades away where a patch of the picture is as large as its cells.
//! `shaders/disc_pattern_on.wgsl` computes the same in f32.

use crate::sky::hash;
use glam::DVec2;
use lensbake_core::accretion::INNERMOST_STABLE;
use std::f64::consts::{PI, TAU};

/// Orbits at r = 3 after which a layer starts anew.
const ORBITS: f64 = 2.0;
/// Number of cells of each octave round the disc, not multiples of each other so that their borders do not line up.
const CELLS: [u32; 4] = [7, 15, 31, 65];
/// Number of cells in a step of 1 of ln r for each cell round the disc: clouds are longer along the orbit than across.
const CELLS_ACROSS: f64 = 0.6;
/// Factor of the sum of all octaves: most of it is then within ±1.
const GAIN: f64 = 1.3;

/// Angular velocity of matter at radius `r` (units of r_s), rad per r_s/c of time at infinity.
pub fn angular_velocity(r: f64) -> f64 {
    (0.5 / (r * r * r)).sqrt()
}

/// Time after which each layer starts anew, r_s/c.
pub fn period() -> f64 {
    ORBITS * TAU / angular_velocity(INNERMOST_STABLE)
}

/// One layer of the pattern.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Layer {
    /// Time since it started, r_s/c.
    pub age: f64,
    /// Its weight, 0 to 1.
    pub weight: f64,
    /// What its noise begins with.
    pub seed: u32,
}

/// The pattern at one time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Pattern {
    /// Contrast, 0 to 1.
    pub contrast: f64,
    pub layers: [Layer; 2],
}

/// A place on the disc and the steps across a patch of the picture there, by ln r and azimuth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spot {
    /// Radius, units of r_s.
    pub radius: f64,
    /// Azimuth in the sense of rotation, rad.
    pub azimuth: f64,
    /// Steps of (ln r, azimuth).
    pub steps: [DVec2; 2],
}

impl Pattern {
    /// The pattern at `time` (r_s/c).
    pub(crate) fn at(contrast: f64, time: f64) -> Self {
        let layer = |index: u32| {
            let turns = time / period() + 0.5 * f64::from(index);
            let age = turns.rem_euclid(1.0);
            // Different noise each time. It repeats after 2³¹ periods.
            let start = (turns.floor() as i64 as u32).wrapping_mul(2);
            Layer {
                age: age * period(),
                weight: (PI * age).sin(),
                seed: hash(start.wrapping_add(index)),
            }
        };
        Pattern {
            contrast,
            layers: [layer(0), layer(1)],
        }
    }

    /// The factor of the light at `spot`; its mean is 1.
    pub(crate) fn factor(&self, spot: &Spot) -> f64 {
        let sum: f64 = self.layers.iter().map(|layer| layer.value(spot)).sum();
        1.0 + self.contrast * (GAIN * sum).clamp(-1.0, 1.0)
    }
}

impl Layer {
    fn value(&self, spot: &Spot) -> f64 {
        let turned = angular_velocity(spot.radius) * self.age;
        // The noise moves back by d(Ω t)/d ln r = −3/2 Ω t.
        let steps = spot
            .steps
            .map(|step| DVec2::new(step.x, step.y + 1.5 * turned * step.x));
        let at = DVec2::new(spot.radius.ln(), spot.azimuth - turned);
        let mut sum = 0.0;
        let mut strength = 1.0;
        for (octave, cells) in (0u32..).zip(CELLS) {
            let cells_per = DVec2::new(CELLS_ACROSS, 1.0 / TAU) * f64::from(cells);
            let size = (steps[0] * cells_per).length() + (steps[1] * cells_per).length();
            let seen = 1.0 - ((size - 0.4) / 0.8).clamp(0.0, 1.0);
            if seen > 0.0 {
                sum +=
                    strength * seen * noise(at * cells_per, cells, self.seed.wrapping_add(octave));
            }
            strength *= 0.6;
        }
        self.weight * sum
    }
}

/// Gradient noise with cells of size 1, periodic in y after `cells` of them.
fn noise(point: DVec2, cells: u32, seed: u32) -> f64 {
    let cell = point.floor();
    let from = point - cell;
    let weight = from * from * from * (from * (from * 6.0 - 15.0) + 10.0);
    let corner = |right: i32, up: i32| {
        let x = (cell.x as i32).wrapping_add(right).cast_unsigned();
        let y = (cell.y as i32)
            .wrapping_add(up)
            .rem_euclid(cells.cast_signed());
        let bits = hash(hash(seed ^ x).wrapping_add(y.cast_unsigned()));
        let signed = |bits: u32| f64::from(bits & 0xffff) / 32767.5 - 1.0;
        let gradient = DVec2::new(signed(bits), signed(bits >> 16));
        gradient.dot(from - DVec2::new(f64::from(right), f64::from(up)))
    };
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    mix(
        mix(corner(0, 0), corner(1, 0), weight.x),
        mix(corner(0, 1), corner(1, 1), weight.x),
        weight.y,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn spot(radius: f64, azimuth: f64) -> Spot {
        Spot {
            radius,
            azimuth,
            steps: [DVec2::ZERO; 2],
        }
    }

    #[test]
    fn its_mean_is_1() {
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
        for time in 0..20 {
            let pattern = Pattern::at(1.0, 17.3 * f64::from(time));
            for i in 0..100 {
                for j in 0..100 {
                    let radius = (3.0f64.ln() + 1.386 * (f64::from(i) + 0.5) / 100.0).exp();
                    let factor = pattern.factor(&spot(radius, TAU * f64::from(j) / 100.0));
                    assert!((0.0..=2.0).contains(&factor));
                    sum += factor;
                    squares += (factor - 1.0).powi(2);
                    count += 1.0;
                }
            }
        }
        assert!((sum / count - 1.0).abs() < 0.01, "{}", sum / count);
        let deviation = (squares / count).sqrt();
        assert!((0.2..0.6).contains(&deviation), "{deviation}");
    }

    #[test]
    fn it_has_no_seam_and_fades_where_it_is_not_resolved() {
        let pattern = Pattern::at(1.0, 40.0);
        for i in 0..50 {
            let radius = 3.0 + 0.2 * f64::from(i);
            let change =
                pattern.factor(&spot(radius, 1e-7)) - pattern.factor(&spot(radius, TAU - 1e-7));
            assert!(change.abs() < 1e-5, "{change}");
            let coarse = Spot {
                steps: [DVec2::new(0.5, 0.0), DVec2::new(0.0, 2.0)],
                ..spot(radius, 1.0)
            };
            assert_eq!(pattern.factor(&coarse), 1.0);
        }
    }

    proptest! {
        /// Also across the start of a layer.
        #[test]
        fn it_is_continuous_in_time(radius in 3.0..100.0f64, azimuth in 0.0..TAU, half in -9..9i32) {
            let start = 0.5 * f64::from(half) * period();
            let factor = |time: f64| Pattern::at(1.0, time).factor(&spot(radius, azimuth));
            prop_assert!((factor(start - 1e-6) - factor(start + 1e-6)).abs() < 1e-5);
        }

        #[test]
        fn a_layer_turns_with_the_matter(
            radius in 3.0..100.0f64, azimuth in 0.0..TAU, age in 0.0..80.0f64, later in 0.0..80.0f64,
        ) {
            let layer = Layer { age, weight: 1.0, seed: 5 };
            let turned = angular_velocity(radius) * later;
            let moved = Layer { age: age + later, ..layer };
            let change = layer.value(&spot(radius, azimuth)) - moved.value(&spot(radius, azimuth + turned));
            prop_assert!(change.abs() < 1e-9);
        }
    }
}
