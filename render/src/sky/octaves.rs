//! Sums of octaves of gradient noise at many points at once, several lanes to an instruction.

use glam::Vec3;
use pulp::{Arch, Simd, WithSimd};

use super::noise::noise;

/// Points that are computed together: few enough for the cache next to the processor.
const BATCH: usize = 64;
/// Rows of the matrix that rotates and scales space between two octaves, so that their lattices never line up.
const NEXT_OCTAVE: [[f32; 3]; 3] = [
    [0.0, -1.624, -1.218],
    [1.624, 0.7308, -0.9744],
    [1.218, -0.9744, 1.2992],
];
/// Shift of the origin between two octaves; not a multiple of the lattice spacing.
const OCTAVE_SHIFT: [f32; 3] = [17.31, -9.17, 5.83];

/// At each point the sum of `octaves` of [`noise`], each 2.03 times as fine and half as strong as the one before;
/// mostly within ±0.7.
pub(super) fn fractal(points: impl Iterator<Item = Vec3>, octaves: u32) -> Vec<f32> {
    sums(
        points,
        octaves,
        #[inline(always)]
        |value| value,
    )
}

/// Fractal noise at each point, with bright creases where the octaves cross zero; about 0 to 1.
pub(super) fn ridged(points: impl Iterator<Item = Vec3>, octaves: u32) -> Vec<f32> {
    sums(
        points,
        octaves,
        #[inline(always)]
        |value| {
            let crease = (1.0 - 2.5 * value.abs()).max(0.0);
            0.6 * crease * crease
        },
    )
}

fn sums(
    mut points: impl Iterator<Item = Vec3>,
    octaves: u32,
    shape: impl Fn(f32) -> f32 + Copy,
) -> Vec<f32> {
    let arch = Arch::new();
    let mut sums = Vec::new();
    loop {
        let mut batch = Batch::default();
        let mut count = 0;
        for (lane, point) in points.by_ref().take(BATCH).enumerate() {
            batch.at[0][lane] = point.x;
            batch.at[1][lane] = point.y;
            batch.at[2][lane] = point.z;
            count = lane + 1;
        }
        arch.dispatch(AddOctaves {
            batch: &mut batch,
            octaves,
            shape,
        });
        sums.extend_from_slice(&batch.sums[..count]);
        if count < BATCH {
            return sums;
        }
    }
}

/// Points and the sums at them, coordinate by coordinate: the compiler makes one instruction of a step for several.
struct Batch {
    at: [[f32; BATCH]; 3],
    sums: [f32; BATCH],
}

impl Default for Batch {
    fn default() -> Self {
        Batch {
            at: [[0.0; BATCH]; 3],
            sums: [0.0; BATCH],
        }
    }
}

/// Adds the octaves to the sums of a batch. What it calls has to be inlined, to be compiled for the instructions that the
/// processor has.
struct AddOctaves<'a, F> {
    batch: &'a mut Batch,
    octaves: u32,
    shape: F,
}

impl<F: Fn(f32) -> f32> WithSimd for AddOctaves<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Batch {
            at: [xs, ys, zs],
            sums,
        } = self.batch;
        let [to_x, to_y, to_z] = NEXT_OCTAVE;
        let mut strength = 1.0;
        for _ in 0..self.octaves {
            for lane in 0..BATCH {
                let (x, y, z) = (xs[lane], ys[lane], zs[lane]);
                sums[lane] += strength * (self.shape)(noise(x, y, z));
                xs[lane] = to_x[0] * x + to_x[1] * y + to_x[2] * z + OCTAVE_SHIFT[0];
                ys[lane] = to_y[0] * x + to_y[1] * y + to_y[2] * z + OCTAVE_SHIFT[1];
                zs[lane] = to_z[0] * x + to_z[1] * y + to_z[2] * z + OCTAVE_SHIFT[2];
            }
            strength *= 0.5;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::noise::Random;
    use super::*;
    use glam::Mat3;

    /// The sum at one point, octave by octave.
    fn sum_at(mut point: Vec3, octaves: u32, shape: impl Fn(f32) -> f32) -> f32 {
        let [x, y, z] = NEXT_OCTAVE.map(Vec3::from_array);
        let next = Mat3::from_cols(x, y, z).transpose();
        let (mut sum, mut strength) = (0.0, 1.0);
        for _ in 0..octaves {
            sum += strength * shape(noise(point.x, point.y, point.z));
            strength *= 0.5;
            point = next * point + Vec3::from_array(OCTAVE_SHIFT);
        }
        sum
    }

    /// To the last bit, so that a sky does not depend on the instructions that the processor has.
    #[test]
    fn batches_of_any_length_hold_the_sums_of_single_points() {
        let mut random = Random::new(8);
        for count in [0, 1, BATCH - 1, BATCH, BATCH + 1, 3 * BATCH] {
            let points: Vec<Vec3> = (0..count).map(|_| 9.0 * random.direction()).collect();
            let expected = points.iter().map(|&point| sum_at(point, 6, |value| value));
            let expected: Vec<f32> = expected.collect();
            assert_eq!(fractal(points.iter().copied(), 6), expected);
            let crease = |value: f32| 0.6 * (1.0 - 2.5 * value.abs()).max(0.0).powi(2);
            for (sum, point) in ridged(points.iter().copied(), 5).iter().zip(&points) {
                assert!((sum - sum_at(*point, 5, crease)).abs() < 1e-6);
            }
        }
    }
}
