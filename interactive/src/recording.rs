//! A path of the camera: keyframes that the user sets, and the flight along them.

use crate::settings::Settings;
use lensbake_core::Motion;
use lensbake_film::{Channel, Flight, FlightPath, Keyframe, KeyframeMotion, PathError};

/// Time from one keyframe to the next, seconds of the film, where nothing moves the camera by itself.
const SPACING_S: f64 = 3.0;

/// A path of the camera, as far as it is set, and its flight while it plays.
#[derive(Debug, Default)]
pub struct Recording {
    path: FlightPath,
    playing: Option<Playing>,
    /// Seconds for which something has moved the camera since the last keyframe.
    moved_s: f64,
    /// The motion of the last keyframe, by which the camera still moves.
    carried_by: Option<KeyframeMotion>,
}

#[derive(Debug)]
struct Playing {
    flight: Flight,
    time: f64,
}

impl Recording {
    /// The path.
    pub fn path(&self) -> &FlightPath {
        &self.path
    }

    /// Whether the path plays.
    pub fn plays(&self) -> bool {
        self.playing.is_some()
    }

    /// The path in a few words.
    pub fn summary(&self) -> String {
        let keyframes = &self.path.keyframes;
        let seconds = keyframes.last().map_or(0.0, |last| last.time);
        match keyframes.len() {
            0 => "no keyframes".to_owned(),
            1 => "1 keyframe".to_owned(),
            count => format!("{count} keyframes, {seconds:.1} s"),
        }
    }

    /// Replaces the path and plays it. Returns a message.
    ///
    /// # Errors
    /// [`PathError`] if it cannot be flown; then nothing changes.
    pub fn take(&mut self, path: FlightPath) -> Result<String, PathError> {
        let flight = Flight::new(&path)?;
        *self = Recording {
            path,
            playing: Some(Playing { flight, time: 0.0 }),
            ..Recording::default()
        };
        Ok(format!("path: {}", self.summary()))
    }

    /// Adds a keyframe for the camera as it is now. While the camera falls or is in orbit by proper time, the keyframe is at
    /// the time that has passed, and the motion goes on. Returns a message.
    ///
    /// # Errors
    /// A line that says why the path cannot have this keyframe.
    pub fn set_keyframe(&mut self, settings: &Settings) -> Result<String, String> {
        let motion = match settings.view.motion {
            Motion::Rest => KeyframeMotion::Rest,
            Motion::Fall => KeyframeMotion::Fall,
            Motion::Orbit => KeyframeMotion::Orbit,
            Motion::Velocity { .. } => {
                return Err("a path has no motion by a velocity: press O for another".into());
            }
        };
        let by_itself = motion != KeyframeMotion::Rest && settings.moves();
        let goes_on = by_itself && self.carried_by == Some(motion) && self.moved_s > 0.0;
        let time = self.path.keyframes.last().map_or(0.0, |last| {
            last.time + if goes_on { self.moved_s } else { SPACING_S }
        });
        let mut keyframe = looks(settings, time);
        if !goes_on {
            place(&mut keyframe, settings, motion);
        }
        if let Some(before) = self.path.keyframes.last() {
            unwind(&mut keyframe, before);
        }
        let mut path = self.path.clone();
        path.keyframes.push(keyframe);
        Flight::new(&path).map_err(|problem| problem.to_string())?;
        self.path = path;
        self.playing = None;
        self.moved_s = 0.0;
        self.carried_by = by_itself.then_some(motion);
        let count = self.path.keyframes.len();
        Ok(match count {
            1 => {
                "keyframe 1: move, and press K for the next; J plays them, N saves them".to_owned()
            }
            _ => format!("keyframe {count} at {time:.1} s"),
        })
    }

    /// Takes the last keyframe back. Returns a message.
    pub fn take_back(&mut self) -> String {
        self.playing = None;
        self.carried_by = None;
        match self.path.keyframes.pop() {
            Some(_) => self.summary(),
            None => "there is no keyframe to take back: K sets one".to_owned(),
        }
    }

    /// Plays the path from its beginning, or stops it. Returns a message.
    pub fn play_or_stop(&mut self) -> String {
        if self.playing.take().is_some() {
            return "stopped".to_owned();
        }
        if self.path.keyframes.len() < 2 {
            return "a path has at least two keyframes: K sets one".to_owned();
        }
        match Flight::new(&self.path) {
            Ok(flight) => {
                self.playing = Some(Playing { flight, time: 0.0 });
                format!("playing {}", self.summary())
            }
            Err(problem) => problem.to_string(),
        }
    }

    /// Moves the camera along the path by `seconds`, if it plays. Returns a message at its end.
    pub(crate) fn advance(&mut self, settings: &mut Settings, seconds: f64) -> Option<String> {
        if settings.moves() {
            self.moved_s += seconds;
        }
        let playing = self.playing.as_mut()?;
        let end = playing.flight.seconds();
        let time = playing.time.min(end);
        playing.time += seconds;
        let view = &mut settings.view;
        let shot = playing.flight.shot(time, (view.width, view.height));
        *view = shot.view;
        settings.exposure =
            (shot.exposure as f32).clamp(*Settings::EXPOSURES.start(), *Settings::EXPOSURES.end());
        settings.stop_falling();
        if time < end {
            return None;
        }
        self.playing = None;
        Some("the end of the path: J plays it again".to_owned())
    }
}

/// A keyframe that says where the camera looks.
fn looks(settings: &Settings, time: f64) -> Keyframe {
    let view = &settings.view;
    Keyframe {
        time,
        yaw: Some(view.yaw_deg),
        pitch: Some(view.pitch_deg),
        roll: Some(view.roll_deg),
        fov: Some(view.fov_deg),
        exposure: Some(settings.exposure.into()),
        ..Keyframe::default()
    }
}

/// Makes `keyframe` say where the camera is and how it moves from there.
fn place(keyframe: &mut Keyframe, settings: &Settings, motion: KeyframeMotion) {
    let view = &settings.view;
    keyframe.motion = Some(motion);
    keyframe.radius = Some(view.radius);
    keyframe.orbit = Some(view.orbit_deg);
    keyframe.latitude = Some(view.latitude_deg);
    keyframe.heading = (motion == KeyframeMotion::Orbit).then_some(view.heading_deg);
    keyframe.clock_rate = (motion != KeyframeMotion::Rest).then(|| settings.clock_rate());
}

/// Angles that go round: the window keeps them from −180° to 180°.
const ROUND: [Channel; 4] = [
    Channel::Orbit,
    Channel::Heading,
    Channel::Yaw,
    Channel::Roll,
];

/// Adds whole turns to the angles of `keyframe`, so that each is near that of the keyframe before.
fn unwind(keyframe: &mut Keyframe, before: &Keyframe) {
    for channel in ROUND {
        if let (Some(angle), Some(last)) = (channel.of(keyframe), channel.of(before)) {
            let turns = ((last - angle) / 360.0).round();
            channel.set(keyframe, angle + 360.0 * turns);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_render::camera::View;

    fn settings(radius: f64, orbit_deg: f64) -> Settings {
        let view = View {
            radius,
            orbit_deg,
            ..View::default()
        };
        Settings::new(view, 0.05)
    }

    #[test]
    fn what_is_set_is_played() {
        let mut recording = Recording::default();
        let mut shown = settings(20.0, 170.0);
        recording.set_keyframe(&shown).unwrap();
        assert_eq!(
            recording.play_or_stop(),
            "a path has at least two keyframes: K sets one"
        );
        recording.set_keyframe(&settings(5.0, -150.0)).unwrap();
        assert_eq!(recording.summary(), "2 keyframes, 3.0 s");
        recording.play_or_stop();
        assert_eq!(recording.advance(&mut shown, 1.5), None);
        assert!((shown.view.radius - 20.0).abs() < 1e-9 && shown.view.orbit_deg == 170.0);
        assert_eq!(recording.advance(&mut shown, 1.5), None);
        // The short way round, and half-way in ln(r − 1).
        assert!(
            (shown.view.orbit_deg - 190.0).abs() < 1e-9,
            "{:?}",
            shown.view
        );
        assert!((shown.view.radius - (1.0 + 76.0_f64.sqrt())).abs() < 1e-9);
        let said = recording.advance(&mut shown, 1.5).unwrap();
        assert!(said.contains("J plays it again"), "{said}");
        assert!((shown.view.radius - 5.0).abs() < 1e-9 && !recording.plays());
        recording.take_back();
        recording.take_back();
        assert!(recording.take_back().contains("K sets one"));
    }

    #[test]
    fn a_fall_goes_on_between_keyframes() {
        let mut recording = Recording::default();
        let mut falling = settings(6.0, 0.0);
        falling.let_go();
        // The first frame begins the fall.
        falling.advance(0.0);
        recording.set_keyframe(&falling).unwrap();
        for _ in 0..40 {
            recording.advance(&mut falling, 0.05);
            falling.advance(0.05);
        }
        falling.view.yaw_deg = 30.0;
        recording.set_keyframe(&falling).unwrap();
        let [_, second] = recording.path().keyframes[..] else {
            panic!("two keyframes")
        };
        assert!((second.time - 2.0).abs() < 1e-9 && second.radius.is_none());
        let flight = Flight::new(recording.path()).unwrap();
        let arrived = flight.shot(second.time, (64, 36)).view;
        let off = arrived.radius / falling.view.radius - 1.0;
        assert!(off.abs() < 1e-6, "{off} {:?}", recording.path());
        assert!((arrived.yaw_deg - 30.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_keyframe_is_refused() {
        let mut recording = Recording::default();
        let mut moving = settings(6.0, 0.0);
        moving.view.motion = Motion::Velocity {
            radial: 0.1,
            tangential: 0.0,
        };
        let said = recording.set_keyframe(&moving).unwrap_err();
        assert!(said.contains("press O"), "{said}");
        assert!(recording.path().keyframes.is_empty());
    }
}
