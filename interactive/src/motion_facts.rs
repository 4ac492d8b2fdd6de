//! What the panel says about the motion of the camera: where it is, its speed, and its proper times.

use crate::settings::Settings;
use crate::title;
use lensbake_core::geodesic::{fall_time, orbit_rate, orbit_speed};
use lensbake_core::{Motion, R_PHOTON};

/// Where a radius lies.
pub fn region(radius: f64) -> &'static str {
    if radius < 1.0 {
        "below the horizon"
    } else if radius == 1.0 {
        "at the horizon"
    } else if radius < R_PHOTON {
        "between horizon and photon sphere"
    } else if radius == R_PHOTON {
        "at the photon sphere"
    } else {
        "outside the photon sphere"
    }
}

/// What to say about the motion: names and values.
pub fn facts(settings: &Settings) -> Vec<(&'static str, String)> {
    let view = &settings.view;
    let mut facts = Vec::new();
    match view.motion {
        Motion::Rest => (),
        Motion::Fall => {
            facts.push(("speed", fall_speed(view.radius)));
            facts.push(("singularity in", time(fall_time(view.radius))));
            let passed = settings.falling().map(|fall| time(fall.passed()));
            facts.extend(passed.map(|passed| ("fallen for", passed)));
        }
        Motion::Orbit => {
            let speed = orbit_speed(view.radius).map(speed);
            let period = orbit_rate(view.radius).map(|rate| time(std::f64::consts::TAU / rate));
            facts.extend(speed.map(|speed| ("speed", speed)));
            facts.extend(period.map(|period| ("period", period)));
        }
        Motion::Velocity { radial, tangential } => {
            let mut text = speed(radial.hypot(tangential));
            if view.radius <= 1.0 {
                text += " against free fall";
            }
            facts.push(("speed", text));
            facts.push(("velocity", view.motion.to_string()));
        }
    }
    facts
}

/// What letting go does now, as the name of a button.
pub fn let_go_name(settings: &Settings) -> &'static str {
    match settings.falling() {
        None => "Let go",
        Some(fall) if fall.runs() => "Pause",
        Some(fall) if fall.has_ended(settings.view.radius) => "Fall again",
        Some(_) => "Go on",
    }
}

/// The way back to where the camera let go, as the name of a button, if it has let go.
pub fn way_back_name(settings: &Settings) -> Option<String> {
    let start = settings.falling()?.start();
    Some(format!("Back to r = {}", title::radius(start.radius)))
}

/// The speed of the free fall relative to the observer at rest.
fn fall_speed(radius: f64) -> String {
    match radius > 1.0 {
        true => speed((1.0 / radius).sqrt()),
        false => "nobody is at rest here".to_owned(),
    }
}

/// A speed in units of c. Close to 1 it is told apart from it.
fn speed(speed: f64) -> String {
    let places = 1.0 - (1.0 - speed).log10().floor();
    format!("{speed:.*} c", places.clamp(3.0, 17.0) as usize)
}

/// A proper time with two decimals, or two significant digits if it is short.
pub fn time(time: f64) -> String {
    let places = match time > 0.0 {
        true => 1.0 - time.log10().floor(),
        false => 2.0,
    };
    format!("{time:.*} r_s/c", places.clamp(2.0, 12.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::at;

    #[track_caller]
    fn says(settings: &Settings, known: &[(&str, &str)]) {
        let facts = facts(settings);
        let facts: Vec<_> = facts
            .iter()
            .map(|(what, value)| (*what, value.as_str()))
            .collect();
        assert_eq!(facts, known);
    }

    #[test]
    fn each_motion_has_its_facts() {
        says(&at(3.0, Motion::Rest), &[]);
        let falling = [("speed", "0.500 c"), ("singularity in", "5.33 r_s/c")];
        says(&at(4.0, Motion::Fall), &falling);
        let inside = [
            ("speed", "nobody is at rest here"),
            ("singularity in", "0.24 r_s/c"),
        ];
        says(&at(0.5, Motion::Fall), &inside);
        // 2π · 3 √3.
        let orbit = [("speed", "0.500 c"), ("period", "32.65 r_s/c")];
        says(&at(3.0, Motion::Orbit), &orbit);
        let velocity = Motion::Velocity {
            radial: -0.3,
            tangential: 0.4,
        };
        let parts = ("velocity", "-0.3,0.4");
        says(&at(3.0, velocity), &[("speed", "0.500 c"), parts]);
        says(
            &at(0.5, velocity),
            &[("speed", "0.500 c against free fall"), parts],
        );
    }

    #[test]
    fn the_clock_of_the_fall_is_shown() {
        let mut settings = at(4.0, Motion::Rest);
        settings.let_go();
        settings.advance(0.0);
        settings.advance(2.0 / settings.clock_rate());
        let [.., left, passed] = &facts(&settings)[..] else {
            panic!("too few facts")
        };
        assert_eq!(left, &("singularity in", "3.33 r_s/c".to_owned()));
        assert_eq!(passed, &("fallen for", "2.00 r_s/c".to_owned()));
    }

    #[test]
    fn numbers_keep_their_digits() {
        assert_eq!(time(83.333), "83.33 r_s/c");
        assert_eq!(time(fall_time(0.01)), "0.00067 r_s/c");
        assert_eq!(time(0.0), "0.00 r_s/c");
        assert_eq!(speed(0.99995), "0.999950 c");
        assert_eq!(speed(0.02), "0.020 c");
    }

    #[test]
    fn regions_end_at_horizon_and_photon_sphere() {
        for (radius, words) in [
            (0.5, "below the horizon"),
            (1.0, "at the horizon"),
            (1.2, "between"),
            (1.5, "at the photon sphere"),
            (25.0, "outside"),
        ] {
            assert!(region(radius).contains(words), "{radius}");
        }
    }
}
