//! The built-in coordinate grid.

use std::f32::consts::{FRAC_PI_2, PI};

use glam::Vec3;

use super::Sky;

/// Spacing of circles of latitude and meridians: 15°.
const STEP: f32 = PI / 12.0;
/// Spacing of meridians within 15° of a pole, where they would crowd: 45°.
const POLAR_STEP: f32 = PI / 4.0;
/// Half the width of a line: 0.13°.
const THIN: f32 = 0.0023;
/// Half the width of the equator and the prime meridian: 0.35°.
const THICK: f32 = 0.0061;
const LINE: Vec3 = Vec3::splat(0.75);
const MAIN_LINE: Vec3 = Vec3::new(1.0, 0.92, 0.55);
/// Brightness of the dark squares of the chequerboard relative to the others.
const DARK: f32 = 0.55;
/// Tints of the octants: bit 0 of the index is set where x < 0, bit 1 where y < 0, bit 2 where
/// z < 0.
const TINTS: [Vec3; 8] = [
    Vec3::new(0.30, 0.03, 0.04),
    Vec3::new(0.02, 0.20, 0.05),
    Vec3::new(0.34, 0.14, 0.01),
    Vec3::new(0.01, 0.18, 0.17),
    Vec3::new(0.25, 0.02, 0.20),
    Vec3::new(0.03, 0.08, 0.34),
    Vec3::new(0.20, 0.22, 0.02),
    Vec3::new(0.15, 0.02, 0.36),
];

/// Returns a sky of thin circles of latitude and longitude every 15° over tinted squares, with
/// `face_texels` texels along the edge of a face. The equator and the prime meridian (longitude 0,
/// through −Z) are thick; within 15° of a pole there is a meridian only every 45°.
///
/// # Panics
///
/// If `face_texels` is 0.
pub fn grid(face_texels: u32) -> Sky {
    let texel = 2.0 / face_texels as f32;
    Sky::from_fn(face_texels, |dir| light(dir, texel))
}

/// Light of the grid in a unit direction; the edges of its lines are `blur` rad wide.
fn light(dir: Vec3, blur: f32) -> Vec3 {
    let longitude = dir.x.atan2(-dir.z);
    let latitude = dir.y.atan2(dir.x.hypot(dir.z));
    let meridian_step = if latitude.abs() > FRAC_PI_2 - STEP {
        POLAR_STEP
    } else {
        STEP
    };
    let to_parallel = distance_to_multiple(latitude, STEP);
    // On the sphere, a meridian is a great circle.
    let to_meridian =
        (latitude.cos() * distance_to_multiple(longitude, meridian_step).sin()).asin();
    let thin = coverage(to_parallel.min(to_meridian), THIN, blur);
    let to_prime = if dir.z < 0.0 { dir.x.abs() } else { FRAC_PI_2 };
    let thick = coverage(latitude.abs().min(to_prime), THICK, blur);

    let odd_square = (latitude / STEP).floor() + (longitude / meridian_step).floor();
    let shade = if odd_square.rem_euclid(2.0) < 0.5 {
        1.0
    } else {
        DARK
    };
    (shade * tint(dir)).lerp(LINE, thin).lerp(MAIN_LINE, thick)
}

fn tint(dir: Vec3) -> Vec3 {
    let bit = |negative: bool, value: usize| if negative { value } else { 0 };
    TINTS[bit(dir.x < 0.0, 1) + bit(dir.y < 0.0, 2) + bit(dir.z < 0.0, 4)]
}

fn distance_to_multiple(angle: f32, step: f32) -> f32 {
    (angle - (angle / step).round() * step).abs()
}

/// Share of a texel that a line covers, from the distance of the texel's centre from the line's middle (all in rad).
fn coverage(distance: f32, half_width: f32, blur: f32) -> f32 {
    ((half_width - distance) / blur + 0.5).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(longitude: f32, latitude: f32) -> Vec3 {
        let (longitude, latitude) = (longitude.to_radians(), latitude.to_radians());
        let level = latitude.cos();
        let dir = Vec3::new(
            level * longitude.sin(),
            latitude.sin(),
            -level * longitude.cos(),
        );
        light(dir, 0.001)
    }

    #[test]
    fn lines_lie_every_15_degrees_and_every_45_near_the_poles() {
        for latitude in [-60.0, -45.0, 15.0, 75.0] {
            assert_eq!(at(22.0, latitude), LINE);
        }
        for longitude in [-165.0, -15.0, 30.0, 180.0] {
            assert_eq!(at(longitude, 33.0), LINE);
        }
        assert_ne!(at(30.0, 80.0), LINE);
        assert_eq!(at(135.0, -80.0), LINE);
        assert_eq!(at(100.0, 0.2), MAIN_LINE);
        assert_eq!(at(0.1, 40.0), MAIN_LINE);
    }

    #[test]
    fn a_meridian_is_as_wide_near_the_pole_as_elsewhere() {
        for latitude in [3.0_f32, 40.0, 70.0, 85.0] {
            let aside = THIN.to_degrees() / latitude.to_radians().cos();
            assert_eq!(at(45.0 + 0.7 * aside, latitude), LINE, "{latitude}");
            assert!(
                at(45.0 + 1.3 * aside, latitude).max_element() < 0.4,
                "{latitude}"
            );
        }
    }

    #[test]
    fn the_eight_octants_differ() {
        let mut pairs = 0;
        for (index, tint) in TINTS.iter().enumerate() {
            for other in &TINTS[..index] {
                assert!((tint - other).length() > 0.1, "{tint} {other}");
                pairs += 1;
            }
        }
        assert_eq!(pairs, 28);
    }
}
