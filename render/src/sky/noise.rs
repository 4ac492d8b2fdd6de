//! Random numbers and gradient noise in 3D from integer hashes: the same on every machine.

use glam::Vec3;

/// Factors that spread lattice points over 32 bits: the fractional bits of √5, √7 and √11, made odd.
const X_FACTOR: u32 = 0x3c6e_f373;
const Y_FACTOR: u32 = 0xa54f_f53b;
const Z_FACTOR: u32 = 0x510e_527f;

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
///
/// Has no branches and no arrays, so that the compiler can compute it at several points at once.
#[inline(always)]
pub(super) fn noise(x: f32, y: f32, z: f32) -> f32 {
    let (left, x) = hash_and_fraction(x, X_FACTOR);
    let (below, y) = hash_and_fraction(y, Y_FACTOR);
    let (near, z) = hash_and_fraction(z, Z_FACTOR);
    let right = left.wrapping_add(X_FACTOR);
    let above = below.wrapping_add(Y_FACTOR);
    let far = near.wrapping_add(Z_FACTOR);
    let weight = weight(x);
    let along_x = [
        mix(
            corner(left ^ below ^ near, x, y, z),
            corner(right ^ below ^ near, x - 1.0, y, z),
            weight,
        ),
        mix(
            corner(left ^ above ^ near, x, y - 1.0, z),
            corner(right ^ above ^ near, x - 1.0, y - 1.0, z),
            weight,
        ),
        mix(
            corner(left ^ below ^ far, x, y, z - 1.0),
            corner(right ^ below ^ far, x - 1.0, y, z - 1.0),
            weight,
        ),
        mix(
            corner(left ^ above ^ far, x, y - 1.0, z - 1.0),
            corner(right ^ above ^ far, x - 1.0, y - 1.0, z - 1.0),
            weight,
        ),
    ];
    let weight = self::weight(y);
    mix(
        mix(along_x[0], along_x[1], weight),
        mix(along_x[2], along_x[3], weight),
        self::weight(z),
    )
}

/// The share of a coordinate's lattice index in the hash of a lattice point, and the coordinate's fraction. The coordinate is
/// within ±2²².
#[inline(always)]
fn hash_and_fraction(x: f32, factor: u32) -> (u32, f32) {
    // Added to 1.5 · 2²³, a number is rounded to an integer, which the last bits of the sum hold. A cast to an integer would
    // be checked number by number.
    const ROUNDING: f32 = 12_582_912.0;
    let sum = x + ROUNDING;
    let rounded = sum - ROUNDING;
    let above = rounded > x;
    let index = sum
        .to_bits()
        .wrapping_sub(ROUNDING.to_bits() + u32::from(above));
    let floor = rounded - if above { 1.0 } else { 0.0 };
    (index.wrapping_mul(factor), x - floor)
}

/// Smooth step from 0 to 1.
#[inline(always)]
fn weight(x: f32) -> f32 {
    x * x * x * (x * (x * 6.0 - 15.0) + 10.0)
}

#[inline(always)]
fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// The gradient at a lattice point times the distance (`x`, `y`, `z`) from it.
#[inline(always)]
fn corner(hashed: u32, x: f32, y: f32, z: f32) -> f32 {
    let hash = hash(hashed);
    slope(hash >> 2) * x + slope(hash >> 12) * y + slope(hash >> 22) * z
}

/// Cubic step from 0 at `low` to 1 at `high`.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A number in −1 to 1 from the last ten bits of `bits`: n / 511.5 − 1.
#[inline(always)]
fn slope(bits: u32) -> f32 {
    // Two products are faster than a division. Those with the first 14 bits of the reciprocal are exact, so that the sum is
    // rounded as the quotient is; a test compares all of them.
    const FIRST_BITS: f32 = f32::from_bits((1.0_f32 / 511.5).to_bits() & !0x3ff);
    const LAST_BITS: f32 = (1.0 / 511.5 - FIRST_BITS as f64) as f32;
    let n = (bits & 1023).cast_signed() as f32;
    n * FIRST_BITS + n * LAST_BITS - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lattice index of a coordinate, and its fraction.
    #[test]
    fn coordinates_are_split_into_floor_and_fraction() {
        for (x, floor) in [
            (-2.0, -2),
            (-1.5, -2),
            (-0.5, -1),
            (-0.1, -1),
            (0.0, 0),
            (0.5, 0),
            (0.9, 0),
            (1.5, 1),
            (3.0, 3),
            (-1234.7, -1235),
            (3e6, 3_000_000),
        ] {
            let index = |hashed: u32| hashed.cast_signed();
            let (hashed, fraction) = hash_and_fraction(x, 1);
            assert_eq!((index(hashed), fraction), (floor, x - floor as f32), "{x}");
        }
    }

    #[test]
    fn slopes_are_rounded_as_by_a_division() {
        for n in 0..1024 {
            assert_eq!(slope(n | 0xabcd_ec00), n as f32 / 511.5 - 1.0, "{n}");
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
            let value = noise(point.x, point.y, point.z);
            let near = point + 1e-3 * random.direction();
            let change = (noise(near.x, near.y, near.z) - value).abs();
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
        let value = noise(0.3, -4.6, 12.2);
        assert!((value - NOISE_AT_POINT).abs() < 1e-6, "{value}");
    }

    const HASH_OF_ONE: u32 = 1_606_308_346;
    const NOISE_AT_POINT: f32 = 0.119_075_745;
}
