//! Choice of the camera's motion.

use crate::settings::Settings;
use lensbake_core::{CoreError, Motion, MovingFrame};

/// The motions that can always be chosen, in the order in which the key cycles through them.
const MOTIONS: [Motion; 3] = [Motion::Rest, Motion::Fall, Motion::Orbit];

/// The name in panel and title bar.
pub fn name(motion: Motion) -> String {
    match motion {
        Motion::Rest => "at rest".to_owned(),
        Motion::Fall => "free fall".to_owned(),
        Motion::Orbit => "circular orbit".to_owned(),
        Motion::Velocity { .. } => format!("velocity {motion}"),
    }
}

/// Why nobody can move so at this radius, if nobody can.
pub fn problem(radius: f64, motion: Motion) -> Option<CoreError> {
    MovingFrame::new(radius, motion).err()
}

impl Settings {
    /// The motions to choose from: the usual ones, and the velocity that a flag gave.
    pub fn motions(&self) -> impl Iterator<Item = Motion> {
        MOTIONS.into_iter().chain(self.given_velocity)
    }

    /// Chooses a motion. A fall by proper time ends with it.
    pub fn choose_motion(&mut self, motion: Motion) {
        self.fall = None;
        self.view.motion = motion;
    }

    /// Chooses the next motion that is possible at this radius. If no other is, chooses to be at rest, which then is
    /// refused with the reason.
    pub(crate) fn choose_next_motion(&mut self) {
        let all: Vec<Motion> = self.motions().collect();
        let now = all.iter().position(|&motion| motion == self.view.motion);
        let after = now.map_or(0, |now| now + 1);
        let others = all.iter().cycle().skip(after).take(all.len());
        let next = others
            .copied()
            .filter(|&motion| motion != self.view.motion)
            .find(|&motion| problem(self.view.radius, motion).is_none());
        self.choose_motion(next.unwrap_or(Motion::Rest));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::at;

    /// The motions after one to four presses of the key.
    fn cycle(mut settings: Settings) -> [Motion; 4] {
        [(); 4].map(|()| {
            settings.choose_next_motion();
            settings.view.motion
        })
    }

    #[test]
    fn the_key_goes_through_the_motions_that_are_possible() {
        use Motion::{Fall, Orbit, Rest};
        assert_eq!(cycle(at(3.0, Rest)), [Fall, Orbit, Rest, Fall]);
        assert_eq!(cycle(at(1.2, Rest)), [Fall, Rest, Fall, Rest]);
        let velocity = Motion::Velocity {
            radial: 0.1,
            tangential: 0.2,
        };
        assert_eq!(cycle(at(3.0, velocity)), [Rest, Fall, Orbit, velocity]);
        assert_eq!(cycle(at(0.5, velocity)), [Fall, velocity, Fall, velocity]);
    }

    #[test]
    fn below_the_horizon_the_key_asks_for_rest_to_be_told_why_not() {
        let mut settings = at(0.5, Motion::Fall);
        settings.choose_next_motion();
        assert_eq!(settings.view.motion, Motion::Rest);
        assert!(problem(0.5, Motion::Rest).is_some());
    }
}
