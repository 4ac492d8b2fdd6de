//! Text of the title bar.

use super::settings::Settings;

/// The title of a window with the sky of this name.
pub fn title(sky: &str, settings: &Settings) -> String {
    let who = match settings.deflection {
        true => settings.comparison.name(),
        false => "no deflection",
    };
    format!(
        "lensbake – {sky} – {who} – r = {} – orbit {}×",
        radius(settings.view.radius),
        settings.orbit_speed(),
    )
}

/// A radius with two decimals; near the horizon with two significant digits of r − 1.
pub fn radius(radius: f64) -> String {
    let places = 1.0 - (radius - 1.0).log10().floor();
    format!("{radius:.*}", places.clamp(2.0, 17.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_are_told_apart_from_the_horizon() {
        let read = [
            (25.0, "25.00"),
            (2.0, "2.00"),
            (1.5, "1.50"),
            (1.005, "1.0050"),
            (1.000_000_12, "1.00000012"),
            (5000.0, "5000.00"),
        ];
        for (r, text) in read {
            assert_eq!(radius(r), text);
        }
        assert_ne!(radius(1.0f64.next_up()), radius(1.0));
    }
}
