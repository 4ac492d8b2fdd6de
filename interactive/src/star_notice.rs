//! The notice that stars are missing, shown once while they are.

use lensbake_render::gpu::StarLight;
use std::time::Duration;

/// Time for which all stars must be present before the notice is repeated: in a moving picture they may come and
/// go.
const ALL_THERE: Duration = Duration::from_secs(10);

const NOTICE: &str = "some stars are missing: they have more images than the GPU has room for";

/// State of the notice.
#[derive(Debug, Default)]
pub struct StarNotice {
    last_missing: Option<Duration>,
}

impl StarNotice {
    /// The notice to show after the GPU reported `light` at `now`, if any.
    pub fn of(&mut self, light: StarLight, now: Duration) -> Option<&'static str> {
        if light == StarLight::Whole {
            return None;
        }
        let last = self.last_missing.replace(now);
        let is_news = last.is_none_or(|last| now.saturating_sub(last) > ALL_THERE);
        is_news.then_some(NOTICE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_said_once_while_stars_are_missing_and_again_after_a_while() {
        let mut notice = StarNotice::default();
        let start = Duration::ZERO;
        let mut at = |seconds, light| notice.of(light, start + Duration::from_secs(seconds));
        assert_eq!(at(0, StarLight::Whole), None);
        assert_eq!(at(1, StarLight::PartLost), Some(NOTICE));
        for seconds in 2..60 {
            let light = [StarLight::Whole, StarLight::PartLost][seconds as usize % 2];
            assert_eq!(at(seconds, light), None);
        }
        assert_eq!(at(61, StarLight::Whole), None);
        assert_eq!(at(75, StarLight::PartLost), Some(NOTICE));
    }
}
