//! The noise of [`super::noise`] at several points at once, with the same bits: the loops are over arrays of points, which
//! the compiler turns into instructions for several numbers, and every operation is that of one point. `pulp` compiles
//! them for AVX2 as well and chooses when the program runs.

use glam::Vec3;

use super::noise::{NEXT_OCTAVE, OCTAVE_SHIFT, X_FACTOR, Y_FACTOR, Z_FACTOR, crease, hash};

/// Points of which the noise is computed together.
pub(super) const LANES: usize = 8;

/// A number for each point.
pub(super) type Values = [f32; LANES];

/// The coordinates x, y and z of the points.
pub(super) type Points = [Values; 3];

/// `f(i)` for each point i.
#[inline(always)]
pub(super) fn each<T: Copy>(f: impl Fn(usize) -> T) -> [T; LANES] {
    let mut values = [f(0); LANES];
    for (i, value) in values.iter_mut().enumerate() {
        *value = f(i);
    }
    values
}

/// The points `f(i)`.
#[inline(always)]
pub(super) fn points(f: impl Fn(usize) -> Vec3) -> Points {
    let points: [Vec3; LANES] = each(f);
    [
        each(|i| points[i].x),
        each(|i| points[i].y),
        each(|i| points[i].z),
    ]
}

/// [`super::noise::fractal`] at each point.
#[inline(always)]
pub(super) fn fractal(points: Points, octaves: u32) -> Values {
    octave_sum(points, octaves, |value| value)
}

/// [`super::noise::ridged`] at each point.
#[inline(always)]
pub(super) fn ridged(points: Points, octaves: u32) -> Values {
    octave_sum(points, octaves, crease)
}

#[inline(always)]
fn octave_sum(mut points: Points, octaves: u32, shape: impl Fn(f32) -> f32) -> Values {
    let (mut sum, mut strength) = ([0.0; LANES], 1.0);
    for _ in 0..octaves {
        let values = noise(&points);
        sum = each(|i| sum[i] + strength * shape(values[i]));
        strength *= 0.5;
        let [x, y, z] = points;
        let [a, b, c] = NEXT_OCTAVE.to_cols_array_2d();
        for (axis, along) in points.iter_mut().enumerate() {
            let shift = OCTAVE_SHIFT[axis];
            *along = each(|i| a[axis] * x[i] + b[axis] * y[i] + c[axis] * z[i] + shift);
        }
    }
    sum
}

/// The cells of the points along one axis, the way into them, and its weight.
struct Along {
    cell: [u32; LANES],
    from: Values,
    weight: Values,
}

#[inline(always)]
fn along(coordinate: &Values) -> Along {
    let cell: [i32; LANES] = each(|i| floor(coordinate[i]));
    let from: Values = each(|i| coordinate[i] - cell[i] as f32);
    Along {
        cell: each(|i| cell[i].cast_unsigned()),
        from,
        weight: each(|i| from[i] * from[i] * from[i] * (from[i] * (from[i] * 6.0 - 15.0) + 10.0)),
    }
}

/// The floor of a number below 2²²: rounded by a sum and corrected by a comparison, because a cast of a number that may not
/// fit is slow.
#[inline(always)]
fn floor(x: f32) -> i32 {
    // 3 · 2²²: the sum with it is rounded to an integer, which is then in its lowest bits.
    const ROUNDING: f32 = 12_582_912.0;
    let rounded = (x + ROUNDING).to_bits().cast_signed() - ROUNDING.to_bits().cast_signed();
    rounded - i32::from(x < rounded as f32)
}

/// [`super::noise::noise`] at each point.
#[inline(always)]
fn noise([x, y, z]: &Points) -> Values {
    let (x, y, z) = (along(x), along(y), along(z));
    let on_x = [lattice(&x, 0, X_FACTOR), lattice(&x, 1, X_FACTOR)];
    let on_y = [lattice(&y, 0, Y_FACTOR), lattice(&y, 1, Y_FACTOR)];
    let on_z = [lattice(&z, 0, Z_FACTOR), lattice(&z, 1, Z_FACTOR)];
    let mut slopes = [[0.0; LANES]; 8];
    for (corner, slopes) in slopes.iter_mut().enumerate() {
        let [a, b, c] = [corner & 1, corner >> 1 & 1, corner >> 2];
        *slopes = each(|i| {
            let hash = hash(on_x[a][i] ^ on_y[b][i] ^ on_z[c][i]);
            signed(hash, 2) * (x.from[i] - a as f32)
                + signed(hash, 12) * (y.from[i] - b as f32)
                + signed(hash, 22) * (z.from[i] - c as f32)
        });
    }
    each(|i| {
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let along_x = |corner: usize| mix(slopes[corner][i], slopes[corner + 1][i], x.weight[i]);
        let along_y = |corner: usize| mix(along_x(corner), along_x(corner + 2), y.weight[i]);
        mix(along_y(0), along_y(4), z.weight[i])
    })
}

/// The part of the hash that comes from the lattice point `step` cells on along one axis.
#[inline(always)]
fn lattice(along: &Along, step: u32, factor: u32) -> [u32; LANES] {
    each(|i| along.cell[i].wrapping_add(step).wrapping_mul(factor))
}

/// A number in −1 to 1 from ten bits of the hash.
#[inline(always)]
fn signed(hash: u32, shift: u32) -> f32 {
    divided(((hash >> shift) & 1023).cast_signed() as f32) - 1.0
}

/// x / 511.5, rounded the same, for the integers from 0 to 1023: a division takes as long as ten products.
#[inline(always)]
fn divided(x: f32) -> f32 {
    const REST: f32 = (1.0 / 511.5 - 1.0 / 512.0_f64) as f32;
    x * (1.0 / 512.0) + x * REST
}

#[cfg(test)]
mod tests {
    use super::super::noise;
    use super::*;

    #[test]
    fn a_quotient_is_rounded_as_a_division_rounds_it() {
        for x in 0..1024 {
            let x = x as f32;
            assert_eq!(divided(x).to_bits(), (x / 511.5).to_bits(), "{x}");
        }
    }

    #[test]
    fn many_points_have_the_noise_of_each_of_them() {
        let mut random = noise::Random::new(8);
        for scale in [0.0, 1.0, 4.0, 1e3] {
            for _ in 0..2000 {
                let at: [Vec3; LANES] = std::array::from_fn(|_| scale * random.direction());
                let smooth = fractal(points(|i| at[i]), 6);
                let creased = ridged(points(|i| at[i]), 6);
                for i in 0..LANES {
                    assert_eq!(smooth[i], noise::fractal(at[i], 6), "{}", at[i]);
                    assert_eq!(creased[i], noise::ridged(at[i], 6), "{}", at[i]);
                }
            }
        }
    }

    #[test]
    fn floor_is_the_floor() {
        for (x, expected) in [
            (-2.0, -2),
            (-1.5, -2),
            (-0.1, -1),
            (0.0, 0),
            (0.9, 0),
            (3.0, 3),
            (2.5, 2),
            (1e6, 1_000_000),
        ] {
            assert_eq!(floor(x), expected);
        }
    }
}
