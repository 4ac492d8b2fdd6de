//! Resolution of the picture relative to the window, fixed or dynamic.

use std::time::Duration;

/// Choice of the resolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Resolution {
    /// The window's resolution.
    Full,
    /// Supersampling: 2 × 2 pixels per pixel of the window.
    Supersampled,
    /// Dynamic resolution: as many pixels as the frame-time target permits.
    Auto,
    /// A quarter of the window's width and height.
    Quarter,
    /// Half the window's width and height.
    Half,
}

impl Resolution {
    /// All choices, in the order in which the key cycles through them.
    pub const ALL: [Resolution; 5] = [
        Resolution::Full,
        Resolution::Supersampled,
        Resolution::Auto,
        Resolution::Quarter,
        Resolution::Half,
    ];

    /// The name in the panel.
    pub fn name(self) -> &'static str {
        match self {
            Resolution::Full => "1",
            Resolution::Supersampled => "2×2",
            Resolution::Auto => "automatic",
            Resolution::Quarter => "1/4",
            Resolution::Half => "1/2",
        }
    }

    /// Pixels of the picture per pixel of the window along each side; for [`Resolution::Auto`] the scale of
    /// `auto`.
    pub fn scale(self, auto: &AutoScale) -> f64 {
        match self {
            Resolution::Full => 1.0,
            Resolution::Supersampled => 2.0,
            Resolution::Auto => auto.scale,
            Resolution::Quarter => 0.25,
            Resolution::Half => 0.5,
        }
    }
}

/// Dynamic resolution: adjusts the scale to meet a frame-time target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AutoScale {
    scale: f64,
}

impl AutoScale {
    /// Range of the scale.
    pub const RANGE: std::ops::RangeInclusive<f64> = 0.25..=1.0;
    /// Part of the target that drawing may take; the rest is for the window system.
    const SHARE: f64 = 0.85;
    /// The scale does not change while the frame time differs from its aim by less than this part, so that it
    /// settles.
    const TOLERANCE: f64 = 0.15;
    /// Part of the way to the right scale that is made per frame.
    const STRIDE: f64 = 0.3;
    /// Time between frames, as a part of the target, from which on frames count as late. Below, the screen may set the
    /// pace.
    const LATE: f64 = 1.3;
    /// Factor by which the scale grows with each frame that is not late.
    const GROWTH: f64 = 1.005;

    /// Adjusts the scale to the time between two frames, where the GPU's own times are not known. A frame that is late
    /// makes the scale smaller; one that is not makes it a little larger, because it may have waited for the screen.
    pub fn learn_from_interval(&mut self, interval: Duration, target: Duration) {
        if interval.as_secs_f64() > Self::LATE * target.as_secs_f64() {
            self.learn(interval, target);
        } else {
            self.scale = (Self::GROWTH * self.scale).min(*Self::RANGE.end());
        }
    }

    /// Adjusts the scale after a frame at the present scale took this long.
    pub fn learn(&mut self, took: Duration, target: Duration) {
        let aim = Self::SHARE * target.as_secs_f64();
        let ratio = took.as_secs_f64().max(1e-6) / aim;
        if (ratio - 1.0).abs() < Self::TOLERANCE {
            return;
        }
        // The time is proportional to the number of pixels.
        let right = self.scale / ratio.sqrt();
        let next = self.scale + Self::STRIDE * (right - self.scale);
        self.scale = next.clamp(*Self::RANGE.start(), *Self::RANGE.end());
    }
}

impl Default for AutoScale {
    fn default() -> Self {
        AutoScale { scale: 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frame time (ms) after 200 frames on a machine that takes `full_ms` for the full picture, plus a constant 1
    /// ms.
    fn settled(full_ms: f64, target_ms: f64) -> f64 {
        let mut auto = AutoScale::default();
        let ms = |auto: &AutoScale| 1.0 + full_ms * auto.scale * auto.scale;
        for _ in 0..200 {
            let took = Duration::from_secs_f64(1e-3 * ms(&auto));
            auto.learn(took, Duration::from_secs_f64(1e-3 * target_ms));
        }
        ms(&auto)
    }

    #[test]
    fn the_time_between_frames_holds_the_frame_rate_too() {
        let target = Duration::from_millis(20);
        let screen = Duration::from_millis(16);
        // The picture takes `whole` at full resolution, and the screen shows it at its next refresh.
        for (whole_ms, right) in [(5.0, 1.0), (40.0, 0.7), (400.0, 0.25)] {
            let mut auto = AutoScale::default();
            let mut late = 0;
            for frame in 0..400 {
                let took = Duration::from_secs_f64(1e-3 * whole_ms * auto.scale * auto.scale);
                auto.learn_from_interval(took.max(screen), target);
                late += usize::from(frame >= 100 && took > target.mul_f64(AutoScale::LATE));
            }
            assert!(
                (auto.scale - right).abs() < 0.2,
                "{whole_ms} {}",
                auto.scale
            );
            assert!(late < 30 || right == 0.25, "{whole_ms} {late}");
        }
    }

    #[test]
    fn the_target_is_held_where_it_can_be() {
        for full_ms in [20.0, 40.0, 80.0, 150.0] {
            let ms = settled(full_ms, 16.0);
            assert!((11.0..16.0).contains(&ms), "{full_ms} ms: {ms} ms");
        }
        assert_eq!(settled(5.0, 16.0), 6.0, "a fast machine draws all pixels");
        let least = 1.0 + 4000.0 * 0.25 * 0.25;
        assert!(
            (settled(4000.0, 16.0) - least).abs() < 1.0,
            "a slow one the least"
        );
    }

    #[test]
    fn it_comes_to_rest() {
        let mut auto = AutoScale::default();
        let mut last = Vec::new();
        for _ in 0..100 {
            let took = Duration::from_secs_f64(0.040 * auto.scale * auto.scale);
            auto.learn(took, Duration::from_millis(16));
            last.push(auto.scale);
        }
        assert!(last[80..].windows(2).all(|pair| pair[0] == pair[1]));
    }
}
