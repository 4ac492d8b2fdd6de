//! How many pixels are drawn for each of the window's.

use std::time::Duration;

/// The choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Resolution {
    /// As many as the window has.
    Full,
    /// Two by two for each of the window's.
    Supersampled,
    /// As many as the frame-time target allows.
    Auto,
    /// A quarter each way.
    Quarter,
    /// Half each way.
    Half,
}

impl Resolution {
    /// All of them, in the order of the key.
    pub const ALL: [Resolution; 5] = [
        Resolution::Full,
        Resolution::Supersampled,
        Resolution::Auto,
        Resolution::Quarter,
        Resolution::Half,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Resolution::Full => "1",
            Resolution::Supersampled => "2×2",
            Resolution::Auto => "automatic",
            Resolution::Quarter => "1/4",
            Resolution::Half => "1/2",
        }
    }

    /// Pixels drawn along each side for a pixel of the window, `auto` of them if that is left to the
    /// machine.
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

/// Finds the scale that holds a frame-time target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AutoScale {
    scale: f64,
}

impl AutoScale {
    /// The scales it may choose.
    pub const RANGE: std::ops::RangeInclusive<f64> = 0.25..=1.0;
    /// The part of the target that the drawing may take; the rest is for the window system.
    const SHARE: f64 = 0.85;
    /// It stays where the time is within this part of what it aims at, so that the picture is at rest.
    const TOLERANCE: f64 = 0.15;
    /// How much of the way to the right scale it goes in a frame.
    const STRIDE: f64 = 0.3;

    /// Learns what a frame at the present scale took.
    pub fn learn(&mut self, took: Duration, target: Duration) {
        let aim = Self::SHARE * target.as_secs_f64();
        let ratio = took.as_secs_f64().max(1e-6) / aim;
        if (ratio - 1.0).abs() < Self::TOLERANCE {
            return;
        }
        // The time goes with the number of pixels.
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

    /// A machine that takes so many ms for the full picture, and 1 ms whatever it draws.
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
