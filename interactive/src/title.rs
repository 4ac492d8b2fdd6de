//! Text of the title bar.

use crate::motion_choice;
use crate::settings::Settings;
use lensbake_core::Motion;

/// The title of a window with the sky of this name.
pub fn title(sky: &str, settings: &Settings) -> String {
    let who = match settings.deflection {
        true => settings.comparison.name(),
        false => "no deflection",
    };
    let radius = radius(settings.view.radius);
    let motion = motion(settings);
    format!("lensbake – {sky} – {who} – r = {radius} – {motion}")
}

/// The motion, and what moves.
fn motion(settings: &Settings) -> String {
    let motion = settings.view.motion;
    let name = motion_choice::name(motion);
    match (motion, settings.falling()) {
        (Motion::Rest, _) => format!("{name} – orbit {}×", settings.orbit_speed()),
        (Motion::Orbit, _) if settings.true_period => format!("{name} – true period"),
        (_, Some(fall)) if fall.runs() => format!("{name} – falling"),
        (_, Some(fall)) if fall.has_ended(settings.view.radius) => format!("{name} – the end"),
        (_, Some(_)) => format!("{name} – paused"),
        _ => name,
    }
}

/// A radius with two decimals; near the horizon with two significant digits of r − 1, near the singularity with two of
/// r.
pub fn radius(radius: f64) -> String {
    let from_horizon = match radius == 1.0 {
        true => f64::INFINITY,
        false => (radius - 1.0).abs(),
    };
    let places = 1.0 - from_horizon.min(radius).log10().floor();
    format!("{radius:.*}", places.clamp(2.0, 17.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_render::camera::View;

    #[test]
    fn radii_are_told_apart_from_the_horizon() {
        let read = [
            (25.0, "25.00"),
            (2.0, "2.00"),
            (1.5, "1.50"),
            (1.005, "1.0050"),
            (1.000_000_12, "1.00000012"),
            (5000.0, "5000.00"),
            (1.0, "1.00"),
            (0.9988, "0.9988"),
            (0.5, "0.50"),
            (0.034, "0.034"),
            (0.01, "0.010"),
            (0.00123, "0.0012"),
        ];
        for (r, text) in read {
            assert_eq!(radius(r), text);
        }
        for next in [1.0f64.next_up(), 1.0f64.next_down()] {
            assert_ne!(radius(next), radius(1.0));
        }
    }

    #[test]
    fn the_motion_is_shown() {
        let at = |motion| {
            Settings::new(
                View {
                    radius: 3.0,
                    motion,
                    ..View::default()
                },
                0.05,
            )
        };
        let ends = |settings: &Settings, end: &str| {
            let title = title("grid", settings);
            assert!(title.ends_with(end), "{title}");
        };
        ends(&at(Motion::Rest), "– r = 3.00 – at rest – orbit 0×");
        ends(&at(Motion::Fall), "– free fall");
        let mut orbit = at(Motion::Orbit);
        ends(&orbit, "– circular orbit");
        orbit.true_period = true;
        ends(&orbit, "– circular orbit – true period");
        let mut fall = at(Motion::Rest);
        fall.let_go();
        ends(&fall, "– free fall – falling");
        fall.let_go();
        ends(&fall, "– free fall – paused");
        let velocity = Motion::Velocity {
            radial: -0.5,
            tangential: 0.25,
        };
        ends(&at(velocity), "– velocity -0.5,0.25");
    }
}
