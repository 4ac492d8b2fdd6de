//! The tone map, from the light of the sky to what a screen can show. Mirror of `shaders/tone_map.wgsl`.

use glam::Vec3;

/// Light up to this value is unchanged.
pub(crate) const KNEE: f32 = 0.8;

/// Valid exposures, in stops: f32 can hold the light of any sky (at most 65504) after exposure.
pub const EXPOSURES: std::ops::RangeInclusive<f32> = -32.0..=32.0;

/// The tone map: light as a screen shows it, linear and at most 1 per channel, at an `exposure` in stops, each of
/// which doubles the light.
///
/// Let p be the largest channel. Light with p ≤ 0.8 is unchanged. Above that, p becomes 1 − 0.2²/(p − 0.6), which
/// joins with slope 1 and tends to 1. The other channels keep their ratio to p: a bright colour keeps its hue and
/// does not turn white, even where the exposed light overflows f32.
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
