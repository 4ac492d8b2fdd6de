//! Point-spread kernels: how the light of a point is distributed over pixels.
//!
//! The core is the product of the quadratic B-splines in x and y, three pixels wide. At every sub-pixel position
//! its values at the pixel centres add up to one and their centroid is the point, so a moving star keeps its light
//! and does not jitter.
//!
//! A pixel on a screen cannot be brighter than white, so the light of a bright star overflows: the core takes
//! light until the pixel under it would be white, then a round halo around it, then one twice as wide, and so on.
//! A halo of radius R is 7/(πR²) (1 − s²/R²)⁶ at the distance s; from R = 4 on, its values at the pixel centres
//! add up to one within 1e-4.

use glam::{DVec2, Vec3};
use std::f64::consts::PI;

/// Half-width of the core in x and y, pixels.
pub const CORE: f64 = 1.5;

/// Half-widths of the kernels in the order in which they are filled, pixels: that of the core, and the radii of
/// the halos.
pub const REACHES: [f64; 5] = [CORE, 4.0, 8.0, 16.0, 32.0];

/// The fraction of a point's light that falls on a pixel whose centre is `offset` pixels from it, by the kernel of
/// half-width `reach`.
pub fn weight(offset: DVec2, reach: f64) -> f64 {
    if reach == CORE {
        return spline(offset.x) * spline(offset.y);
    }
    let inside = 1.0 - offset.length_squared() / (reach * reach);
    7.0 / (PI * reach * reach) * inside.max(0.0).powi(6)
}

/// The quadratic B-spline.
fn spline(x: f64) -> f64 {
    let x = x.abs();
    if x < 0.5 {
        0.75 - x * x
    } else if x < CORE {
        0.5 * (CORE - x) * (CORE - x)
    } else {
        0.0
    }
}

/// The light, in the brightest channel, that a kernel takes before the next kernel takes any: a pixel at its
/// centre is then white. The last kernel takes all light that is left.
fn capacity(reach: f64) -> f32 {
    if reach == REACHES[REACHES.len() - 1] {
        return f32::INFINITY;
    }
    (1.0 / weight(DVec2::ZERO, reach)) as f32
}

/// Distributes `light` of a point over the kernels: (half-width, light) of each kernel used. Their sum is `light`.
pub fn spread(light: Vec3) -> impl Iterator<Item = (f64, Vec3)> {
    let brightest = light.max_element();
    let mut left = brightest;
    REACHES.into_iter().map_while(move |reach| {
        let taken = left.min(capacity(reach));
        left -= taken;
        (taken > 0.0).then(|| (reach, light * (taken / brightest)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wherever_a_point_lies_its_light_is_one_and_its_middle_is_there() {
        for reach in REACHES {
            for i in 0..=400 {
                let place = DVec2::new(f64::from(i % 21) / 20.0, f64::from(i / 21) / 19.0);
                let (mut sum, mut middle) = (0.0, DVec2::ZERO);
                for (column, row) in (-33..=34).flat_map(|c| (-33..=34).map(move |r| (c, r))) {
                    let pixel = DVec2::new(f64::from(column), f64::from(row));
                    let weight = weight(pixel - place, reach);
                    sum += weight;
                    middle += weight * pixel;
                }
                let (light, shift) = if reach == CORE {
                    (1e-14, 1e-14)
                } else {
                    (1e-4, 5e-4)
                };
                assert!((sum - 1.0).abs() < light, "{reach} {place}: {sum}");
                assert!(
                    (middle - place).length() < shift,
                    "{reach} {place}: {middle}"
                );
            }
        }
    }

    #[test]
    fn spreading_keeps_the_light_and_fills_to_white() {
        for light in [1e-4, 0.5, 1.77, 5.0, 80.0, 1e9] {
            let light = Vec3::new(light, 0.5 * light, 0.1 * light);
            let parts: Vec<(f64, Vec3)> = spread(light).collect();
            let sum: Vec3 = parts.iter().map(|(_, part)| part).sum();
            assert!((sum / light - 1.0).abs().max_element() < 1e-5, "{parts:?}");
            for &(reach, part) in &parts[..parts.len().min(REACHES.len() - 1)] {
                let peak = f64::from(part.x) * weight(DVec2::ZERO, reach);
                assert!(peak < 1.0 + 1e-6, "{parts:?}");
            }
        }
        assert_eq!(spread(Vec3::splat(1.7)).count(), 1);
        assert_eq!(spread(Vec3::ZERO).count(), 0);
    }
}
