//! Random numbers and fractal noise in 3D from integer hashes: the same on every machine.

use std::array::from_fn;

use glam::{IVec3, Mat3, Vec3};

/// Rotates and scales space between two octaves, so that their lattices never line up.
pub(super) const NEXT_OCTAVE: Mat3 = Mat3::from_cols_array(&[
    0.0, 1.624, 1.218, -1.624, 0.7308, -0.9744, -1.218, -0.9744, 1.2992,
]);
/// Shift of the origin between two octaves; not a multiple of the lattice spacing.
pub(super) const OCTAVE_SHIFT: Vec3 = Vec3::new(17.31, -9.17, 5.83);

/// Factors that spread lattice points over 32 bits: the fractional bits of √5, √7 and √11, made odd.
pub(super) const X_FACTOR: u32 = 0x3c6e_f373;
pub(super) const Y_FACTOR: u32 = 0xa54f_f53b;
pub(super) const Z_FACTOR: u32 = 0x510e_527f;

/// Mixes the bits of `x`; a bijection. The factors are the fractional bits of √2 and √3.
#[inline(always)]
pub(crate) fn hash(x: u32) -> u32 {
    let x = (x ^ (x >> 16)).wrapping_mul(0x6a09_e667);
    let x = (x ^ (x >> 15)).wrapping_mul(0xbb67_ae85);
    x ^ (x >> 16)
}

/// A pseudo-random number generator.
pub(super) struct Random {
    state: u32,
}

impl Random {
    pub(super) fn new(seed: u32) -> Self {
        Self { state: hash(seed) }
    }

    /// The next number, uniform in [0, 1).
    pub(super) fn unit(&mut self) -> f32 {
        // A Weyl sequence: its step, 2³² divided by the golden ratio, is odd, so that it visits every state once.
        self.state = self.state.wrapping_add(0x9e37_79b9);
        // 24 bits: the precision of an f32.
        (hash(self.state) >> 8) as f32 / (1 << 24) as f32
    }

    /// The next direction, uniform over the sphere.
    pub(super) fn direction(&mut self) -> Vec3 {
        loop {
            let point = 2.0 * Vec3::new(self.unit(), self.unit(), self.unit()) - Vec3::ONE;
            let square = point.length_squared();
            if square > 0.01 && square <= 1.0 {
                return point / square.sqrt();
            }
        }
    }
}

/// Gradient noise (Perlin): smooth, 0 on average, mostly within ±0.5, with features about 1 across.
pub(super) fn noise(point: Vec3) -> f32 {
    let cell = floor(point);
    let from = point - cell.as_vec3();
    let weight = from * from * from * (from * (from * 6.0 - 15.0) + 10.0);
    // Arrays over the eight corners of the cell, which the compiler can vectorise.
    let hashes: [u32; 8] = from_fn(|corner| {
        let step = |axis: usize| (corner >> axis & 1) as i32;
        let along = |index: i32, factor: u32| index.cast_unsigned().wrapping_mul(factor);
        hash(
            along(cell.x + step(0), X_FACTOR)
                ^ along(cell.y + step(1), Y_FACTOR)
                ^ along(cell.z + step(2), Z_FACTOR),
        )
    });
    let slopes: [f32; 8] = from_fn(|corner| {
        let step = |axis: usize| (corner >> axis & 1) as f32;
        gradient(hashes[corner]).dot(from - Vec3::new(step(0), step(1), step(2)))
    });
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let along_x: [f32; 4] = from_fn(|i| mix(slopes[2 * i], slopes[2 * i + 1], weight.x));
    let along_y: [f32; 2] = from_fn(|i| mix(along_x[2 * i], along_x[2 * i + 1], weight.y));
    mix(along_y[0], along_y[1], weight.z)
}

/// Sum of `octaves` of [`noise`], each 2.03 times as fine and half as strong as the one before; mostly within
/// ±0.7.
pub(super) fn fractal(point: Vec3, octaves: u32) -> f32 {
    octave_sum(point, octaves, |value| value)
}

/// Fractal noise with bright creases where the octaves cross zero; about 0 to 1.
pub(super) fn ridged(point: Vec3, octaves: u32) -> f32 {
    octave_sum(point, octaves, crease)
}

/// An octave of [`ridged`] from its noise.
#[inline(always)]
pub(super) fn crease(value: f32) -> f32 {
    let crease = (1.0 - 2.5 * value.abs()).max(0.0);
    0.6 * crease * crease
}

fn octave_sum(mut point: Vec3, octaves: u32, shape: impl Fn(f32) -> f32) -> f32 {
    let (mut sum, mut strength) = (0.0, 1.0);
    for _ in 0..octaves {
        sum += strength * shape(noise(point));
        strength *= 0.5;
        point = NEXT_OCTAVE * point + OCTAVE_SHIFT;
    }
    sum
}

/// Cubic step from 0 at `low` to 1 at `high`.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Three numbers in −1 to 1, from ten bits of the hash each.
fn gradient(hash: u32) -> Vec3 {
    let signed = |shift: u32| ((hash >> shift) & 1023) as f32 / 511.5 - 1.0;
    Vec3::new(signed(2), signed(12), signed(22))
}

/// Floor by a cast and a comparison: faster than `f32::floor` where that is a library call.
fn floor(point: Vec3) -> IVec3 {
    let truncated = point.as_ivec3();
    let above = point.cmplt(truncated.as_vec3());
    truncated - IVec3::new(i32::from(above.x), i32::from(above.y), i32::from(above.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floor_is_the_floor() {
        for (x, expected) in [
            (-2.0, -2),
            (-1.5, -2),
            (-0.1, -1),
            (0.0, 0),
            (0.9, 0),
            (3.0, 3),
        ] {
            assert_eq!(floor(Vec3::splat(x)), IVec3::splat(expected));
        }
    }

    #[test]
    fn random_numbers_fill_their_range() {
        let mut random = Random::new(5);
        let mut tenths = [0; 10];
        let mut mean_direction = Vec3::ZERO;
        for _ in 0..10_000 {
            tenths[(10.0 * random.unit()) as usize] += 1;
            let direction = random.direction();
            assert!((direction.length() - 1.0).abs() < 1e-6);
            mean_direction += direction / 10_000.0;
        }
        assert!(
            tenths.iter().all(|count| (850..1150).contains(count)),
            "{tenths:?}"
        );
        assert!(mean_direction.length() < 0.03, "{mean_direction}");
    }

    #[test]
    fn noise_is_smooth_and_zero_on_average() {
        let mut random = Random::new(6);
        let (mut sum, mut largest) = (0.0, 0.0_f32);
        for _ in 0..20_000 {
            let point = 30.0 * random.direction();
            let value = noise(point);
            let change = (noise(point + 1e-3 * random.direction()) - value).abs();
            assert!(change < 5e-3, "{point}: {change}");
            sum += value;
            largest = largest.max(value.abs());
        }
        assert!((sum / 20_000.0_f32).abs() < 0.01, "{sum}");
        assert!((0.5..1.0).contains(&largest), "{largest}");
    }

    #[test]
    fn noise_is_the_same_on_every_machine() {
        assert_eq!(hash(1), HASH_OF_ONE);
        let value = noise(Vec3::new(0.3, -4.6, 12.2));
        assert!((value - NOISE_AT_POINT).abs() < 1e-6, "{value}");
    }

    const HASH_OF_ONE: u32 = 1_606_308_346;
    const NOISE_AT_POINT: f32 = 0.119_075_745;
}
