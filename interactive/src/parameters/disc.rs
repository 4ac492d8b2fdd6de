//! The parameters of the disc that are not plain numbers.

use super::{Parameter, SWITCH, chosen, shift_of};

/// Whether the disc is shown, and its radii.
pub(super) const RADII: Parameter = Parameter {
    name: "disc",
    expects: "off, on, or its inner and outer radius IN,OUT in Schwarzschild radii, such as 3,12",
    get: |settings| match settings.shown_disc() {
        Some(disc) => format!("{},{}", disc.inner, disc.outer),
        None => "off".to_owned(),
    },
    set: |settings, text| {
        if let Some(shown) = chosen(&SWITCH, text) {
            settings.disc_shown = shown;
            return Some(());
        }
        let (inner, outer) = text.split_once(',')?;
        let radii = (inner.parse().ok()?, outer.parse().ok()?);
        (settings.disc.inner, settings.disc.outer) = radii;
        settings.disc_shown = true;
        Some(())
    },
};

/// What of the disc's frequency shift is shown.
pub(super) const SHIFT: Parameter = Parameter {
    name: "disc-shift",
    expects: "off, brightness or colour",
    get: |settings| settings.disc.shift.name().to_owned(),
    set: |settings, text| shift_of(text).map(|shift| settings.disc.shift = shift),
};

#[cfg(test)]
mod tests {
    use crate::settings::Settings;
    use lensbake_render::camera::View;

    #[test]
    fn a_disc_keeps_its_radii_while_it_is_off() {
        let mut settings = Settings::new(View::default(), 0.05);
        let mut says = |text: &str| {
            settings.set_parameter("disc", text).unwrap();
            settings.parameter("disc").unwrap()
        };
        assert_eq!(says("on"), "3,12");
        assert_eq!(says("4.5,20"), "4.5,20");
        assert_eq!(says("off"), "off");
        assert_eq!(says("on"), "4.5,20");
    }

    #[test]
    fn texts_that_are_no_disc_are_told() {
        let mut settings = Settings::new(View::default(), 0.05);
        for (name, text) in [
            ("disc", ""),
            ("disc", "3"),
            ("disc", "3,"),
            ("disc", "3,12,20"),
            ("disc", "yes"),
            ("disc-shift", "color"),
            ("inclination", "steep"),
        ] {
            let said = settings.set_parameter(name, text).unwrap_err().to_string();
            let start = format!("{name} is '{text}', but must be ");
            assert!(said.starts_with(&start) && !said.contains('\n'), "{said}");
        }
        assert!(!settings.disc_shown);
    }
}
