//! From the light of the sky to what a screen can show. Twin of `shaders/tone_map.wgsl`.

use glam::Vec3;

/// The same for a GPU: `fn tone_map(light: vec3<f32>, exposure: f32) -> vec3<f32>`.
pub const WGSL: &str = include_str!("shaders/tone_map.wgsl");

/// Light up to here is left alone.
const KNEE: f32 = 0.8;

/// The exposures that make sense, in stops either way: f32 holds the products.
pub const EXPOSURES: std::ops::RangeInclusive<f32> = -32.0..=32.0;

/// The light as a screen shows it, linear and at most 1 a channel, at an `exposure` in stops: each
/// doubles the light.
///
/// With p the greatest channel, light with p ≤ 0.8 is unchanged; above, p becomes
/// 1 − 0.2²/(p − 0.6), which joins with slope 1 and tends to 1, and the other channels keep their
/// ratio to it: a bright colour stays that colour and does not turn white, even where the exposed light is more
/// than f32 holds.
pub fn tone_map(light: Vec3, exposure: f32) -> Vec3 {
    let unexposed = light;
    let light = light * exposure.exp2();
    let peak = light.max_element();
    if peak == f32::INFINITY {
        return unexposed / unexposed.max_element();
    }
    if peak <= KNEE {
        return light;
    }
    let room = 1.0 - KNEE;
    let rolled = 1.0 - room * room / (peak - KNEE + room);
    light * (rolled / peak)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn below_the_knee_nothing_changes() {
        for peak in [0.0, 0.1, 0.8] {
            let light = peak * Vec3::new(0.2, 1.0, 0.7);
            assert_eq!(tone_map(light, 0.0), light);
            assert_eq!(tone_map(0.25 * light, 2.0), light);
        }
    }

    #[test]
    fn highlights_roll_off_to_1_without_a_kink_and_keep_their_hue() {
        let slope = |peak: f32| {
            let step = 1e-3;
            let rise = tone_map(Vec3::splat(peak + step), 0.0) - tone_map(Vec3::splat(peak), 0.0);
            rise.x / step
        };
        assert!((slope(KNEE) - 1.0).abs() < 0.02, "{}", slope(KNEE));
        let mut before = KNEE;
        for i in 1..200 {
            let light = Vec3::new(1.0, 0.5, 0.1) * KNEE * 1.1_f32.powi(i);
            let shown = tone_map(light, 0.0);
            assert!(shown.x > before - 1e-6 && shown.x <= 1.0, "{light} {shown}");
            assert!(
                (shown.y / shown.x - 0.5).abs() < 1e-6 && (shown.z / shown.x - 0.1).abs() < 1e-6
            );
            before = shown.x;
        }
        assert!(before > 0.999);
    }

    #[test]
    fn light_that_overflows_as_it_is_exposed_keeps_its_hue() {
        let shown = tone_map(Vec3::new(1.0, 0.5, 0.1) * 1e32, *EXPOSURES.end());
        assert_eq!(shown, Vec3::new(1.0, 0.5, 0.1));
    }

    #[test]
    fn the_brightest_light_at_the_longest_exposure_is_shown() {
        let shown = tone_map(Vec3::splat(65504.0), *EXPOSURES.end());
        assert!(shown.is_finite() && shown.x <= 1.0, "{shown}");
    }
}
