//! A path of the camera: keyframes that the user sets, and the flight along them.

use crate::settings::Settings;
use lensbake_core::Motion;
use lensbake_film::{
    Channel, Flight, FlightPath, Keyframe, KeyframeMotion, Orientation, PathError,
};
use lensbake_render::camera::{Place, View};

/// Time from one keyframe to the next, in seconds of the film, if nothing has moved the camera by itself.
const SPACING_S: f64 = 3.0;

/// A path of the camera, as far as it is set, and its flight while it plays.
#[derive(Debug, Default)]
pub struct Recording {
    path: FlightPath,
    playing: Option<Playing>,
    carried: Option<Carried>,
}

#[derive(Debug)]
struct Playing {
    flight: Flight,
    time: f64,
    /// The view that was shown last. If it has changed since, the user has moved the camera.
    shown: Option<View>,
}

/// The motion that has moved the camera by itself since the last keyframe.
#[derive(Debug, Clone, Copy)]
struct Carried {
    motion: KeyframeMotion,
    /// The heading where the motion began, degrees.
    heading_deg: f64,
    /// For how long, seconds.
    seconds: f64,
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
        self.keep(path);
        self.play(flight);
        Ok(format!("path: {}", self.summary()))
    }

    /// Replaces the path, without playing it.
    pub fn keep(&mut self, path: FlightPath) {
        *self = Recording {
            path,
            ..Recording::default()
        };
    }

    /// Adds a keyframe for the camera as it is now. While the camera falls or is in orbit by proper time, the keyframe is at
    /// the time that has passed, and the motion goes on. Returns a message.
    ///
    /// # Errors
    /// A line that says why the path cannot have this keyframe.
    pub fn set_keyframe(&mut self, settings: &Settings) -> Result<String, String> {
        let motion = motion_of(settings)?;
        let moves = settings.moves();
        let carried = self.carried.filter(|carried| carried.seconds > 0.0);
        if motion != KeyframeMotion::Rest && !moves && carried.is_none() {
            return Err(match motion {
                KeyframeMotion::Fall => "in a path, a camera in free fall falls: press G to let go",
                _ => "in a path, a camera in orbit moves along it: press R for the true period",
            }
            .into());
        }
        let passed = carried.map_or(SPACING_S, |carried| carried.seconds);
        let time = (self.path.keyframes.last()).map_or(0.0, |last| last.time + passed);
        let goes_on = carried.filter(|carried| carried.motion == motion);
        let on_the_way = goes_on.map(|carried| on_the_way(settings, time, carried.heading_deg));
        let flown = on_the_way.and_then(|keyframe| self.with(keyframe).ok());
        let flown = flown.filter(|(_, flight)| arrives(flight, time, settings));
        let heading_deg = match (&flown, goes_on) {
            (Some(_), Some(carried)) => carried.heading_deg,
            _ => settings.view.heading_deg,
        };
        let (path, _) = match flown {
            Some(flown) => flown,
            None => {
                let keyframe = at_a_place(settings, time, motion);
                self.with(keyframe).map_err(|problem| problem.to_string())?
            }
        };
        self.path = path;
        self.playing = None;
        self.carried = (motion != KeyframeMotion::Rest && moves).then_some(Carried {
            motion,
            heading_deg,
            seconds: 0.0,
        });
        Ok(match self.path.keyframes.len() {
            1 => {
                "keyframe 1: move, and press K for the next; J plays them, N saves them".to_owned()
            }
            count => format!("keyframe {count} at {time:.1} s"),
        })
    }

    /// The path with another keyframe at its end, and its flight.
    fn with(&self, mut keyframe: Keyframe) -> Result<(FlightPath, Flight), PathError> {
        if let Some(before) = self.path.keyframes.last() {
            unwind(&mut keyframe, before);
        }
        let mut path = self.path.clone();
        path.keyframes.push(keyframe);
        let flight = Flight::new(&path)?;
        Ok((path, flight))
    }

    /// Takes the last keyframe back. Returns a message.
    pub fn take_back(&mut self) -> String {
        self.playing = None;
        self.carried = None;
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
                self.play(flight);
                format!("playing {}", self.summary())
            }
            Err(problem) => problem.to_string(),
        }
    }

    fn play(&mut self, flight: Flight) {
        self.carried = None;
        self.playing = Some(Playing {
            flight,
            time: 0.0,
            shown: None,
        });
    }

    /// Moves the camera along the path by `seconds`, if it plays. If the user has moved the camera meanwhile, the path stops.
    /// Returns a message where it stops.
    pub(crate) fn advance(&mut self, settings: &mut Settings, seconds: f64) -> Option<String> {
        let Some(playing) = &mut self.playing else {
            if let Some(carried) = self.carried.as_mut().filter(|_| settings.moves()) {
                carried.seconds += seconds;
            }
            return None;
        };
        if playing.shown.is_some_and(|shown| shown != settings.view) {
            self.playing = None;
            return Some("the path has stopped: J plays it again".to_owned());
        }
        let end = playing.flight.seconds();
        let time = playing.time.min(end);
        playing.time += seconds;
        let view = &mut settings.view;
        let shot = playing.flight.shot(time, (view.width, view.height));
        *view = shot.view;
        playing.shown = Some(shot.view);
        let exposures = Settings::EXPOSURES;
        settings.exposure = (shot.exposure as f32).clamp(*exposures.start(), *exposures.end());
        // Nothing else moves the camera, neither now nor after the end.
        settings.stop_falling();
        settings.true_period = false;
        settings.orbit_speed = 0;
        if time < end {
            return None;
        }
        self.playing = None;
        Some("the end of the path: J plays it again".to_owned())
    }
}

/// The motion of the camera as a path has it.
fn motion_of(settings: &Settings) -> Result<KeyframeMotion, String> {
    match settings.view.motion {
        Motion::Rest => Ok(KeyframeMotion::Rest),
        Motion::Fall => Ok(KeyframeMotion::Fall),
        Motion::Orbit => Ok(KeyframeMotion::Orbit),
        Motion::Velocity { .. } => {
            Err("a path has no motion by a velocity: press O for another".into())
        }
    }
}

/// Whether `flight` is at `time` where the camera is.
fn arrives(flight: &Flight, time: f64, settings: &Settings) -> bool {
    const NEAR: f64 = 1e-3;
    let (there, here) = (flight.shot(time, (1, 1)).view, &settings.view);
    let [from, to] = [&there, here].map(|view| Place::of(view).direction());
    let apart = from.distance(to);
    (there.radius / here.radius - 1.0).abs() < NEAR && apart < NEAR
}

/// A keyframe that leaves the place to the motion, which began at this heading and has turned the picture with it.
fn on_the_way(settings: &Settings, time: f64, heading_deg: f64) -> Keyframe {
    let view = &settings.view;
    let turned = match view.motion {
        Motion::Orbit => view.heading_deg - heading_deg,
        _ => 0.0,
    };
    looks(Orientation::of(view).turned(-turned), settings, time)
}

/// A keyframe that says where the camera is and how it moves from there.
fn at_a_place(settings: &Settings, time: f64, motion: KeyframeMotion) -> Keyframe {
    let view = &settings.view;
    Keyframe {
        motion: Some(motion),
        radius: Some(view.radius),
        orbit: Some(view.orbit_deg),
        latitude: Some(view.latitude_deg),
        heading: (motion == KeyframeMotion::Orbit).then_some(view.heading_deg),
        clock_rate: (motion != KeyframeMotion::Rest).then(|| settings.clock_rate()),
        ..looks(Orientation::of(view), settings, time)
    }
}

/// A keyframe that says where the camera looks.
fn looks(orientation: Orientation, settings: &Settings, time: f64) -> Keyframe {
    Keyframe {
        time,
        yaw: Some(orientation.yaw_deg),
        pitch: Some(orientation.pitch_deg),
        roll: Some(orientation.roll_deg),
        fov: Some(settings.view.fov_deg),
        exposure: Some(settings.exposure.into()),
        ..Keyframe::default()
    }
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
    use glam::DVec3;
    use lensbake_render::camera::Camera;

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
        shown.disc_shown = true;
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
        // Nothing of the disc is in a path.
        assert!(shown.disc_shown);
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
    fn an_inclined_orbit_is_played_as_it_was_seen() {
        let mut recording = Recording::default();
        let mut orbiting = settings(8.0, 30.0);
        orbiting.view.motion = Motion::Orbit;
        orbiting.view.heading_deg = 40.0;
        orbiting.true_period = true;
        recording.set_keyframe(&orbiting).unwrap();
        let mut seen = Vec::new();
        for _ in 0..2 {
            for _ in 0..60 {
                recording.advance(&mut orbiting, 0.5);
                orbiting.advance(0.5);
            }
            orbiting.view.yaw_deg += 5.0;
            recording.set_keyframe(&orbiting).unwrap();
            seen.push(Camera::new(&orbiting.view).unwrap());
        }
        let flight = Flight::new(recording.path()).unwrap();
        for (keyframe, seen) in recording.path().keyframes[1..].iter().zip(seen) {
            assert_eq!((keyframe.motion, keyframe.orbit), (None, None));
            let view = orbiting.view;
            let shot = flight.shot(keyframe.time, (view.width, view.height));
            let played = Camera::new(&shot.view).unwrap();
            for axis in [DVec3::X, DVec3::Z] {
                let off = played.sky_from_hole * axis - seen.sky_from_hole * axis;
                assert!(off.length() < 1e-6, "{off}");
            }
            let on_sky = |camera: &Camera| camera.sky_from_hole * camera.right.normalize();
            let off = on_sky(&played) - on_sky(&seen);
            assert!(off.length() < 1e-6, "{off}");
        }
    }

    #[test]
    fn a_camera_that_was_moved_by_hand_is_where_it_is() {
        let mut recording = Recording::default();
        let mut falling = settings(9.0, 0.0);
        falling.let_go();
        falling.advance(0.0);
        recording.set_keyframe(&falling).unwrap();
        recording.advance(&mut falling, 1.0);
        falling.advance(1.0);
        falling.view.radius = 3.0;
        recording.set_keyframe(&falling).unwrap();
        assert_eq!(recording.path().keyframes[1].radius, Some(3.0));
        assert!((recording.path().keyframes[1].time - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_path_stops_when_the_user_moves_the_camera() {
        let mut recording = Recording::default();
        let mut shown = settings(20.0, 0.0);
        recording.set_keyframe(&shown).unwrap();
        recording.set_keyframe(&settings(5.0, 0.0)).unwrap();
        recording.play_or_stop();
        shown.true_period = true;
        shown.orbit_speed = 2;
        recording.advance(&mut shown, 0.5);
        assert!(!shown.true_period && shown.orbit_speed == 0);
        assert_eq!(recording.advance(&mut shown, 0.5), None);
        shown.view.yaw_deg += 1.0;
        let moved = shown.view;
        assert!(
            recording
                .advance(&mut shown, 0.5)
                .unwrap()
                .contains("stopped")
        );
        assert!(!recording.plays() && shown.view == moved);
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
        for (motion, key) in [(Motion::Fall, "press G"), (Motion::Orbit, "press R")] {
            moving.view.motion = motion;
            let said = recording.set_keyframe(&moving).unwrap_err();
            assert!(said.contains(key), "{said}");
        }
        assert!(recording.path().keyframes.is_empty());
    }
}
