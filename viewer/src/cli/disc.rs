//! Options of the disc around the hole.

use super::scene::ShiftName;
use super::values::radii;
use clap::{Args, ValueEnum};
use lensbake_core::thin_disc::ThinDiscError;
use lensbake_render::disc::{Disc, DiscError, Orientation};
use std::sync::LazyLock;
use thiserror::Error;

/// A disc of matter around the hole.
#[derive(Debug, Clone, Default, Args)]
pub struct DiscArgs {
    /// A thin disc of matter on circular orbits around the hole, between these radii in Schwarzschild radii [default:
    /// no disc; without a value 3,12]. The inner radius is at least 3, that of the innermost stable orbit.
    #[arg(
        long,
        value_name = "R_IN,R_OUT",
        num_args = 0..=1,
        default_missing_value = default_radii(),
        value_parser = radii
    )]
    pub disc: Option<(f64, f64)>,
    /// Inclination of the disc: the angle of its axis from the line of sight, 0 to see it face-on, 90 edge-on [default:
    /// 80]. It holds for longitude and latitude 0; --orbit, --latitude and a film move the camera round a disc that
    /// stays. With --hole it holds for the camera itself.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub inclination: Option<f64>,
    /// Angle of the line of nodes, about which the disc is inclined, from the horizontal in the picture [default: 0].
    /// Counter-clockwise; seen from where --inclination holds.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub node: Option<f64>,
    /// Share of the light behind the disc that it takes away, from 0 to 1 [default: 1].
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub disc_opacity: Option<f64>,
    /// Temperature of the disc where it is hottest, in kelvins [default: 5000].
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    pub disc_temperature: Option<f64>,
    /// Brightness of the disc where it is hottest, without its frequency shift [default: 1, which is white].
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    pub disc_brightness: Option<f64>,
    /// What of the frequency shift of the disc's light is shown, which --shift does not change [default: colour].
    #[arg(long, value_enum)]
    pub disc_shift: Option<ShiftName>,
    /// Contrast of a pattern of clouds on the disc, which turns with its matter, from 0 to 1 [default: 0, a smooth disc].
    #[arg(long, value_name = "CONTRAST", allow_negative_numbers = true)]
    pub disc_pattern: Option<f64>,
    /// Time at which the pattern is shown, in r_s/c: the inner rim at r = 3 turns once in 46.2 [default: 0].
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub disc_time: Option<f64>,
}

/// Why there can be no such disc.
#[derive(Debug, Error)]
pub enum DiscArgsError {
    /// An option of the disc without the disc.
    #[error("{0} is for a disc, and there is none; add --disc")]
    NoDisc(&'static str),
    /// A value is out of range.
    #[error("{}: {_0}", flag_of(_0))]
    Value(#[from] DiscError),
    /// The rate of a film's disc is out of range.
    #[error("--disc-rate: {0} is not from -{1} to {1} r_s/c per second")]
    Rate(f64, f64),
}

/// The flag whose value `error` refuses.
fn flag_of(error: &DiscError) -> String {
    match error {
        DiscError::Place(ThinDiscError::Inner(_) | ThinDiscError::Outer { .. }) => "--disc".into(),
        DiscError::Place(ThinDiscError::Angle { what, .. }) => format!("--{what}"),
        DiscError::OutOfRange { what, .. } => format!("--disc-{what}"),
    }
}

impl DiscArgs {
    /// The disc that the options describe, if there is one. Its inclination is that for a camera at this longitude and
    /// latitude (degrees).
    ///
    /// # Errors
    /// [`DiscArgsError`] if a value is out of range, or if there is an option of a disc but no disc.
    pub fn disc(&self, seen_from_deg: [f64; 2]) -> Result<Option<Disc>, DiscArgsError> {
        let Some((inner, outer)) = self.disc else {
            let without = self.first_given().map(DiscArgsError::NoDisc);
            return without.map_or(Ok(None), Err);
        };
        let default = Disc::default();
        let angles = default.orientation;
        let disc = Disc {
            inner,
            outer,
            orientation: Orientation {
                inclination_deg: self.inclination.unwrap_or(angles.inclination_deg),
                node_deg: self.node.unwrap_or(angles.node_deg),
                seen_from_deg,
            },
            opacity: self.disc_opacity.unwrap_or(default.opacity),
            peak_kelvin: self.disc_temperature.unwrap_or(default.peak_kelvin),
            brightness: self.disc_brightness.unwrap_or(default.brightness),
            shift: self.disc_shift.map_or(default.shift, Into::into),
            pattern: self.disc_pattern.unwrap_or(default.pattern),
            time: self.disc_time.unwrap_or(default.time),
        };
        disc.check()?;
        Ok(Some(disc))
    }

    /// The first option that is given of those that describe a disc.
    fn first_given(&self) -> Option<&'static str> {
        let options = [
            ("--inclination", self.inclination.is_some()),
            ("--node", self.node.is_some()),
            ("--disc-opacity", self.disc_opacity.is_some()),
            ("--disc-temperature", self.disc_temperature.is_some()),
            ("--disc-brightness", self.disc_brightness.is_some()),
            ("--disc-shift", self.disc_shift.is_some()),
            ("--disc-pattern", self.disc_pattern.is_some()),
            ("--disc-time", self.disc_time.is_some()),
        ];
        let given = options.into_iter().find(|(_, is_given)| *is_given);
        given.map(|(name, _)| name)
    }
}

/// All options of this disc with their values, by name without dashes. The place from which it is seen is that of the
/// camera's options.
pub fn options_of(disc: &Disc) -> [(&'static str, String); 9] {
    let angles = disc.orientation;
    [
        ("disc", radii_text(disc)),
        ("inclination", angles.inclination_deg.to_string()),
        ("node", angles.node_deg.to_string()),
        ("disc-opacity", disc.opacity.to_string()),
        ("disc-temperature", disc.peak_kelvin.to_string()),
        ("disc-brightness", disc.brightness.to_string()),
        ("disc-shift", shift_name(disc)),
        ("disc-pattern", disc.pattern.to_string()),
        ("disc-time", disc.time.to_string()),
    ]
}

/// The radii as --disc takes them.
fn radii_text(disc: &Disc) -> String {
    format!("{},{}", disc.inner, disc.outer)
}

/// The name of what is shown of the frequency shift of the disc.
pub fn shift_name(disc: &Disc) -> String {
    let name = ShiftName::from(disc.shift).to_possible_value();
    name.map_or_else(String::new, |name| name.get_name().to_owned())
}

/// The radii of --disc without a value.
fn default_radii() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(|| radii_text(&Disc::default()));
    &TEXT
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{CommandFactory, Parser};
    use lensbake_render::shift::Shift;

    #[derive(Debug, Parser)]
    struct Only {
        #[command(flatten)]
        disc: DiscArgs,
    }

    fn parsed(arguments: &[&str]) -> DiscArgs {
        let arguments = ["viewer"].iter().chain(arguments);
        Only::try_parse_from(arguments).unwrap().disc
    }

    #[test]
    fn a_disc_without_values_is_the_default_one() {
        assert_eq!(parsed(&[]).disc([0.0; 2]).unwrap(), None);
        let found = parsed(&["--disc"]).disc([0.0; 2]).unwrap();
        assert_eq!(found, Some(Disc::default()));
        let found = parsed(&["--disc", "--node", "10"]).disc([40.0, -7.0]);
        let orientation = found.unwrap().unwrap().orientation;
        assert_eq!(orientation.node_deg, 10.0);
        assert_eq!(orientation.seen_from_deg, [40.0, -7.0]);
    }

    /// The record of a disc describes the same disc.
    #[test]
    fn the_options_of_a_disc_give_it_again() {
        let disc = Disc {
            inner: 3.1,
            outer: 1e3 / 3.0,
            orientation: Orientation {
                inclination_deg: -63.4,
                node_deg: 1e-7,
                seen_from_deg: [12.0, 34.0],
            },
            opacity: 0.7,
            peak_kelvin: 4321.5,
            brightness: 2.5,
            shift: Shift::Brightness,
            pattern: 0.4,
            time: -12.5,
        };
        let options = options_of(&disc).map(|(name, value)| format!("--{name}={value}"));
        let arguments: Vec<&str> = options.iter().map(String::as_str).collect();
        let again = parsed(&arguments).disc([12.0, 34.0]).unwrap();
        assert_eq!(again, Some(disc));
    }

    /// Every option but --disc itself needs the disc, and is recorded with it.
    #[test]
    fn no_option_of_a_disc_is_forgotten() {
        let command = Only::command();
        let names: Vec<&str> = command
            .get_arguments()
            .filter_map(|option| option.get_long())
            .collect();
        let recorded = options_of(&Disc::default()).map(|(name, _)| name);
        assert_eq!(names, recorded);
        for (name, value) in options_of(&Disc::default()).into_iter().skip(1) {
            let flag = format!("--{name}");
            let problem = parsed(&[&flag, &value]).disc([0.0; 2]).unwrap_err();
            assert!(problem.to_string().starts_with(&flag), "{problem}");
        }
    }

    #[test]
    fn the_help_names_the_defaults() {
        let command = Only::command();
        for (name, value) in options_of(&Disc::default()) {
            let option = command.get_arguments().find(|o| o.get_long() == Some(name));
            let help = option.and_then(|o| o.get_help()).unwrap().to_string();
            let default = help.split_once("[default: ").unwrap().1;
            let default = default.split_once(']').unwrap().0;
            let mut words = default.split([' ', ',']);
            let is_named = words.any(|word| word == value) || default.ends_with(&value);
            assert!(is_named, "{name}: {help}");
        }
    }
}
