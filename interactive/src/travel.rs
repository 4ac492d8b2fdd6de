//! What moves the camera while time passes: turning around the hole at rest, the free fall and the circular orbit by
//! proper time.

use crate::fall::{END, Fall, LetGo};
use crate::motion::{self, CLOCK_RATES, ORBIT_DEG_PER_S, wrapped};
use crate::motion_facts;
use crate::settings::Settings;
use crate::title;
use lensbake_core::Motion;
use lensbake_core::geodesic::{fall_time, orbit_rate};
use lensbake_film::Orientation;
use lensbake_render::camera::{Place, View};

impl Settings {
    /// Proper time per second, r_s/c.
    pub fn clock_rate(&self) -> f64 {
        CLOCK_RATES[self.clock_rate]
    }

    /// Makes proper time pass slower or faster, by this many of [`CLOCK_RATES`].
    pub(crate) fn change_clock_rate(&mut self, steps: isize) {
        let rate = self.clock_rate.saturating_add_signed(steps);
        self.clock_rate = rate.min(CLOCK_RATES.len() - 1);
    }

    /// The fall by proper time, if the camera has let go.
    pub fn falling(&self) -> Option<&Fall> {
        let falls = self.view.motion == Motion::Fall;
        self.fall.as_ref().filter(|_| falls)
    }

    /// Lets go. A camera that has already let go pauses, goes on, or at the end falls again from where it let go.
    pub fn let_go(&mut self) {
        let radius = self.view.radius;
        let fall = match self.falling().copied() {
            None => Fall::new(LetGo {
                radius,
                motion: self.view.motion,
            }),
            Some(fall) if fall.has_ended(radius) => {
                self.view.radius = fall.start().radius;
                Fall::new(fall.start())
            }
            Some(mut fall) => {
                match fall.runs() {
                    true => fall.stop(),
                    false => fall.go_on(),
                }
                fall
            }
        };
        self.view.motion = Motion::Fall;
        self.fall = Some(fall);
    }

    /// Stops the fall where it is.
    pub fn stop_falling(&mut self) {
        if let Some(fall) = &mut self.fall {
            fall.stop();
        }
    }

    /// Brings a camera that has let go back to the radius and motion before.
    pub fn back_to_let_go(&mut self) {
        if let Some(start) = self.falling().map(Fall::start) {
            self.view.radius = start.radius;
            self.choose_motion(start.motion);
        }
    }

    /// Whether something moves the camera while time passes.
    pub fn moves(&self) -> bool {
        match self.view.motion {
            Motion::Rest => self.orbit_speed() != 0.0,
            Motion::Fall => self.falling().is_some_and(Fall::runs),
            Motion::Orbit => self.true_period,
            Motion::Velocity { .. } => false,
        }
    }

    /// Moves the camera for `seconds`. Returns a message when the fall has reached its end.
    pub fn advance(&mut self, seconds: f64) -> Option<String> {
        if !self.moves() {
            return None;
        }
        let time = self.clock_rate() * seconds;
        let speed = self.orbit_speed();
        let view = &mut self.view;
        match (view.motion, &mut self.fall) {
            (Motion::Rest, _) => motion::orbit(view, speed * ORBIT_DEG_PER_S * seconds, 0.0),
            (Motion::Orbit, _) => go_along_orbit(view, time),
            (Motion::Fall, Some(fall)) => {
                let step = fall.advance(view.radius, time);
                view.radius = step.radius;
                return step.arrives.then(|| arrival(step.radius, fall));
            }
            _ => (),
        }
        None
    }
}

/// Moves along the circular orbit for the proper time `time`, r_s/c.
fn go_along_orbit(view: &mut View, time: f64) {
    // Where there is no orbit, nothing is drawn either.
    let Ok(rate) = orbit_rate(view.radius) else {
        return;
    };
    let place = Place::of(view).moved(rate * time);
    // The picture turns with the direction of motion, so that it is not turned over beyond a pole.
    let turned = place.heading_deg - view.heading_deg;
    let orientation = Orientation::of(view).turned(turned);
    view.yaw_deg = orientation.yaw_deg;
    view.pitch_deg = orientation.pitch_deg;
    view.roll_deg = orientation.roll_deg;
    view.orbit_deg = wrapped(place.longitude_deg);
    view.latitude_deg = place.latitude_deg;
    view.heading_deg = place.heading_deg;
}

fn arrival(radius: f64, fall: &Fall) -> String {
    let left = motion_facts::time(fall_time(radius));
    let start = fall.start().radius;
    let next = match start > END {
        true => {
            let start = title::radius(start);
            format!("Press G to fall again from r = {start}, T to go back there.")
        }
        false => "Press Down to go farther out.".to_owned(),
    };
    format!("You have reached r = {radius}. The singularity is {left} of proper time away. {next}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::{Change, KeyAction, Movement, key_action};
    use keyboard_types::Code;

    fn at(radius: f64, motion: Motion) -> Settings {
        let view = View {
            radius,
            motion,
            ..View::default()
        };
        Settings::new(view, 0.05)
    }

    /// Advances in frames of `1/hz` for at most `seconds`; returns the messages, and the time of the last frame that
    /// moved something.
    fn run(settings: &mut Settings, seconds: f64, hz: f64) -> (Vec<String>, f64) {
        let (mut said, mut last) = (Vec::new(), 0.0);
        for frame in 0..(seconds * hz).ceil() as usize {
            if settings.moves() {
                last = frame as f64 / hz;
            }
            said.extend(settings.advance(1.0 / hz));
        }
        (said, last)
    }

    #[test]
    fn a_fall_arrives_on_time_says_so_once_and_starts_again() {
        let mut settings = at(3.0, Motion::Rest);
        settings.let_go();
        assert_eq!(settings.view.motion, Motion::Fall);
        let (said, last) = run(&mut settings, 10.0, 60.0);
        let due = (fall_time(3.0) - fall_time(END)) / settings.clock_rate();
        assert!((due..due + 2.0 / 60.0).contains(&last), "{last} {due}");
        let [said] = &said[..] else {
            panic!("{said:?}")
        };
        for words in [
            "r = 0.01",
            "0.00067 r_s/c",
            "G to fall again from r = 3.00",
            "T to go",
        ] {
            assert!(said.contains(words), "{said}");
        }
        assert!(!settings.moves());
        settings.let_go();
        assert_eq!((settings.view.radius, settings.moves()), (3.0, true));
        run(&mut settings, 1.0, 60.0);
        settings.back_to_let_go();
        assert_eq!(
            (settings.view.radius, settings.view.motion),
            (3.0, Motion::Rest)
        );
        assert!(settings.falling().is_none() && !settings.moves());
    }

    #[test]
    fn the_messages_name_the_keys() {
        for (code, action) in [
            (Code::KeyG, KeyAction::Changes(Change::LetGo)),
            (Code::KeyT, KeyAction::Changes(Change::BackToLetGo)),
            (Code::ArrowDown, KeyAction::Held(Movement::Farther)),
        ] {
            assert_eq!(key_action(code), Some(action));
        }
        let mut settings = at(END, Motion::Fall);
        settings.let_go();
        let said = settings.advance(0.1).unwrap();
        assert!(said.contains("Press Down"), "{said}");
    }

    #[test]
    fn the_key_pauses_and_goes_on() {
        let mut settings = at(3.0, Motion::Rest);
        settings.let_go();
        run(&mut settings, 1.0, 60.0);
        settings.let_go();
        let paused = settings.view.radius;
        assert!(paused < 3.0 && !settings.moves());
        run(&mut settings, 1.0, 60.0);
        assert_eq!(settings.view.radius, paused);
        settings.let_go();
        run(&mut settings, 1.0, 60.0);
        assert!(settings.view.radius < paused);
    }

    #[test]
    fn another_motion_ends_the_fall() {
        let mut settings = at(3.0, Motion::Rest);
        settings.let_go();
        settings.choose_motion(Motion::Rest);
        settings.choose_motion(Motion::Fall);
        assert!(!settings.moves() && settings.falling().is_none());
    }

    #[test]
    fn an_orbit_takes_its_period_and_is_closed() {
        let mut settings = at(6.0, Motion::Orbit);
        settings.view.heading_deg = 30.0;
        settings.view.yaw_deg = 20.0;
        let start = settings.view;
        assert_eq!(run(&mut settings, 1.0, 60.0), (vec![], 0.0));
        settings.true_period = true;
        // Kepler's third law for the coordinate time, and the time dilation of the orbit.
        let period = std::f64::consts::TAU * (2.0 * 6f64.powi(3) * (1.0 - 1.5 / 6.0)).sqrt();
        let seconds = period / settings.clock_rate();
        for _ in 0..1000 {
            settings.advance(1e-3 * seconds / 2.0);
        }
        let half = settings.view;
        let off = wrapped(half.orbit_deg - start.orbit_deg - 180.0);
        assert!(
            off.abs() < 1e-9 || (off.abs() - 360.0).abs() < 1e-9,
            "{off}"
        );
        assert!((half.heading_deg + 30.0).abs() < 1e-9, "{half:?}");
        for _ in 0..1000 {
            settings.advance(1e-3 * seconds / 2.0);
        }
        let end = settings.view;
        for (a, b) in [
            (start.orbit_deg, end.orbit_deg),
            (start.latitude_deg, end.latitude_deg),
            (start.heading_deg, end.heading_deg),
            (start.yaw_deg, end.yaw_deg),
            (start.pitch_deg, end.pitch_deg),
            (start.roll_deg, end.roll_deg),
        ] {
            assert!((a - b).abs() < 1e-9, "{end:?}");
        }
        assert_eq!(start.radius, end.radius);
    }

    #[test]
    fn the_orbit_speeds_are_for_the_camera_at_rest() {
        let mut settings = at(6.0, Motion::Rest);
        settings.orbit_speed = 1;
        settings.advance(1.0);
        assert!((settings.view.orbit_deg - ORBIT_DEG_PER_S).abs() < 1e-12);
        for motion in [Motion::Fall, Motion::Orbit] {
            settings.choose_motion(motion);
            assert!(!settings.moves());
        }
    }

    #[test]
    fn the_clock_rates_have_ends() {
        let mut settings = at(3.0, Motion::Rest);
        assert_eq!(settings.clock_rate(), 0.5);
        settings.change_clock_rate(1);
        assert_eq!(settings.clock_rate(), 1.0);
        for (step, end) in [(-1, 0.25), (1, 16.0)] {
            for _ in 0..10 {
                settings.change_clock_rate(step);
            }
            assert_eq!(settings.clock_rate(), end);
        }
    }
}
