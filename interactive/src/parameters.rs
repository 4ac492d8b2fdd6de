//! The settings as texts with names, as the address of a web page holds them and as a panel reads and sets them. The
//! names are those of the options of `viewer render`, where there is such an option.

mod disc;

use crate::motion;
use crate::motion::{CLOCK_RATES, ORBIT_SPEEDS};
use crate::resolution::Resolution;
use crate::settings::{Comparison, SHIFTS, Settings};
use lensbake_core::Motion;
use lensbake_render::lens::Deflection;
use lensbake_render::scene::Sampling;
use lensbake_render::shift::Shift;
use thiserror::Error;

/// A setting with a name.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What a value is, for messages.
    pub expects: &'static str,
    get: fn(&Settings) -> String,
    /// `None` if the text is no value.
    set: fn(&mut Settings, &str) -> Option<()>,
}

/// A parameter that does not exist, or a text that is no value of it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ParameterError {
    /// There is no parameter of this name.
    #[error("there is no setting '{0}'; there are {names}", names = names())]
    Unknown(String),
    /// The text is no value.
    #[error("{name} is '{text}', but must be {expects}")]
    NoValue {
        /// Name of the parameter.
        name: &'static str,
        /// The text.
        text: String,
        /// What a value is.
        expects: &'static str,
    },
}

const SWITCH: [(&str, bool); 2] = [("off", false), ("on", true)];

const METHODS: [(&str, (bool, Comparison)); 5] = [
    ("lut", (true, Comparison::Table)),
    ("direct", (true, Comparison::Direct)),
    ("split", (true, Comparison::Split)),
    ("difference", (true, Comparison::Difference)),
    ("flat", (false, Comparison::Table)),
];

const SAMPLINGS: [(&str, Sampling); 3] = [
    ("filtered", Sampling::Filtered),
    ("anisotropic", Sampling::Anisotropic),
    ("single", Sampling::Single),
];

const RESOLUTIONS: [(&str, Resolution); 5] = [
    ("1", Resolution::Full),
    ("2", Resolution::Supersampled),
    ("auto", Resolution::Auto),
    ("1/4", Resolution::Quarter),
    ("1/2", Resolution::Half),
];

/// Finds the value of a text in a list of choices.
fn chosen<T: Copy>(choices: &[(&str, T)], text: &str) -> Option<T> {
    let found = choices.iter().find(|(name, _)| *name == text);
    found.map(|&(_, value)| value)
}

/// Finds the text of a value in a list of choices; an empty one if it has none.
fn text_of<T: PartialEq>(choices: &[(&str, T)], value: T) -> String {
    let found = choices.iter().find(|(_, one)| *one == value);
    found
        .map(|(name, _)| (*name).to_owned())
        .unwrap_or_default()
}

fn shift_of(text: &str) -> Option<Shift> {
    SHIFTS.into_iter().find(|shift| shift.name() == text)
}

fn index_of(values: &[f64], text: &str) -> Option<usize> {
    let value: f64 = text.parse().ok()?;
    values.iter().position(|one| *one == value)
}

/// The switch that a text stands for: `on` or `off`.
pub fn switch(text: &str) -> Option<bool> {
    chosen(&SWITCH, text)
}

/// The text of a switch.
pub fn switch_name(on: bool) -> String {
    text_of(&SWITCH, on)
}

fn names() -> String {
    PARAMETERS.map(|parameter| parameter.name).join(", ")
}

/// Defines a parameter that is a number in a field of the settings.
macro_rules! number {
    ($name:literal, $expects:literal, $($field:ident).+) => {
        Parameter {
            name: $name,
            expects: $expects,
            get: |settings| settings.$($field).+.to_string(),
            set: |settings, text| text.parse().ok().map(|value| settings.$($field).+ = value),
        }
    };
}

/// Defines a parameter whose field of the settings has one of a list of choices.
macro_rules! choice {
    ($name:literal, $expects:literal, $choices:ident, $field:ident) => {
        Parameter {
            name: $name,
            expects: $expects,
            get: |settings| text_of(&$choices, settings.$field),
            set: |settings, text| chosen(&$choices, text).map(|value| settings.$field = value),
        }
    };
}

/// All parameters, in the order in which an address lists them.
pub const PARAMETERS: [Parameter; 29] = [
    number!("radius", "a number of Schwarzschild radii", view.radius),
    Parameter {
        name: "motion",
        expects: "rest, fall, orbit, or a velocity BR,BT in units of c, such as -0.5,0.3",
        get: |settings| settings.view.motion.to_string(),
        set: |settings, text| {
            let motion: Motion = text.parse().ok()?;
            if let Motion::Velocity { .. } = motion {
                settings.given_velocity = Some(motion);
            }
            // The fall goes on if its own motion is named again.
            if motion != settings.view.motion {
                settings.choose_motion(motion);
            }
            Some(())
        },
    },
    number!("heading", "an angle in degrees", view.heading_deg),
    number!("fov", "an angle in degrees between 0 and 180", view.fov_deg),
    number!("yaw", "an angle in degrees", view.yaw_deg),
    number!("pitch", "an angle in degrees", view.pitch_deg),
    number!("roll", "an angle in degrees", view.roll_deg),
    number!("orbit", "an angle in degrees", view.orbit_deg),
    number!("latitude", "an angle in degrees", view.latitude_deg),
    Parameter {
        name: "shift",
        expects: "off, brightness or colour",
        get: |settings| settings.shift.name().to_owned(),
        set: |settings, text| shift_of(text).map(|shift| settings.shift = shift),
    },
    disc::RADII,
    number!(
        "inclination",
        "an angle in degrees",
        disc.orientation.inclination_deg
    ),
    number!("node", "an angle in degrees", disc.orientation.node_deg),
    number!(
        "disc-opacity",
        "a share of the light from 0 to 1",
        disc.opacity
    ),
    number!(
        "disc-temperature",
        "a number of kelvins from 1000 to 40000",
        disc.peak_kelvin
    ),
    number!(
        "disc-brightness",
        "a factor from 0 to 10000",
        disc.brightness
    ),
    disc::SHIFT,
    number!("exposure", "a number of stops from -8 to 8", exposure),
    choice!("auto-exposure", "on or off", SWITCH, auto_exposure),
    Parameter {
        name: "method",
        expects: "lut, direct, split, difference or flat",
        get: |settings| match settings.deflection {
            true => text_of(&METHODS, (true, settings.comparison)),
            false => "flat".to_owned(),
        },
        set: |settings, text| {
            let (deflection, comparison) = chosen(&METHODS, text)?;
            settings.deflection = deflection;
            // Without deflection there is nothing to compare; what was compared is kept for later.
            if deflection {
                settings.comparison = comparison;
            }
            Some(())
        },
    },
    Parameter {
        name: "step",
        expects: "a number of radians from 0.001 to 0.5",
        get: |settings| settings.step.to_string(),
        set: |settings, text| {
            let step = text.parse().ok()?;
            Deflection::check_step(step).ok()?;
            settings.step = step;
            Some(())
        },
    },
    number!("divider", "a part of the width from 0 to 1", divider),
    number!("gain", "a factor from 1 to 1048576", gain),
    choice!(
        "sampling",
        "filtered, anisotropic or single",
        SAMPLINGS,
        sampling
    ),
    choice!(
        "resolution",
        "1, 2, auto, 1/4 or 1/2",
        RESOLUTIONS,
        resolution
    ),
    number!(
        "frame-time",
        "a number of milliseconds from 4 to 200",
        target_ms
    ),
    Parameter {
        name: "orbit-speed",
        expects: "0, 1, 2 or 4",
        get: |settings| settings.orbit_speed().to_string(),
        set: |settings, text| {
            index_of(&ORBIT_SPEEDS, text).map(|speed| settings.orbit_speed = speed)
        },
    },
    choice!("true-period", "on or off", SWITCH, true_period),
    Parameter {
        name: "pace",
        expects: "0.25, 0.5, 1, 2, 4 or 16 r_s/c per second",
        get: |settings| settings.clock_rate().to_string(),
        set: |settings, text| index_of(&CLOCK_RATES, text).map(|rate| settings.clock_rate = rate),
    },
];

impl Settings {
    /// The value of the parameter of this name as a text, from which [`Settings::set_parameter`] makes the same value;
    /// `None` if there is no such parameter.
    pub fn parameter(&self, name: &str) -> Option<String> {
        find(name).map(|parameter| (parameter.get)(self))
    }

    /// Sets the parameter of this name. Whether the new value can be drawn is for
    /// [`State::settle`](crate::state::State::settle) to check.
    ///
    /// # Errors
    /// [`ParameterError`] if there is no such parameter, or `text` is no value of it; then nothing changes.
    pub fn set_parameter(&mut self, name: &str, text: &str) -> Result<(), ParameterError> {
        let parameter = find(name).ok_or_else(|| ParameterError::Unknown(name.to_owned()))?;
        (parameter.set)(self, text).ok_or_else(|| ParameterError::NoValue {
            name: parameter.name,
            text: text.to_owned(),
            expects: parameter.expects,
        })?;
        self.view = motion::unwound(&self.view);
        Ok(())
    }

    /// The names and values of the parameters that differ from those of `start`, in the order of [`PARAMETERS`].
    pub fn changed_parameters(&self, start: &Settings) -> Vec<(&'static str, String)> {
        let of = |parameter: &Parameter| ((parameter.get)(self), (parameter.get)(start));
        let all = PARAMETERS.iter().map(|one| (one.name, of(one)));
        all.filter(|(_, (now, before))| now != before)
            .map(|(name, (now, _))| (name, now))
            .collect()
    }
}

fn find(name: &str) -> Option<&'static Parameter> {
    static ALL: [Parameter; PARAMETERS.len()] = PARAMETERS;
    ALL.iter().find(|parameter| parameter.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::Change;
    use lensbake_render::camera::View;
    use proptest::prelude::*;

    fn start() -> Settings {
        Settings::new(View::default(), Deflection::DEFAULT_STEP)
    }

    /// Settings after keys and numbers at random.
    fn settings() -> impl Strategy<Value = Settings> {
        let number = || {
            prop_oneof![
                -1e3..1e3f64,
                any::<f64>().prop_filter("", |x| x.is_finite())
            ]
        };
        let changes = prop::collection::vec(0..Change::ALL.len(), 0..40);
        let numbers = prop::collection::vec(number(), Settings::PARTS.len());
        (changes, numbers).prop_map(|(changes, numbers)| {
            let mut settings = start();
            for change in changes {
                settings.change(Change::ALL[change]);
            }
            let view = &mut settings.view;
            [view.radius, view.fov_deg, settings.divider] = [numbers[0], numbers[1], numbers[2]];
            view.yaw_deg = motion::wrapped(numbers[3]);
            view.heading_deg = motion::wrapped(numbers[4]);
            settings.gain = numbers[5] as f32;
            settings.exposure = numbers[6] as f32;
            settings.disc.orientation.inclination_deg = numbers[7];
            [settings.disc.opacity, settings.disc.brightness] = [numbers[8], numbers[9]];
            if settings.disc_shown {
                [settings.disc.inner, settings.disc.outer] = [numbers[10], numbers[11]];
            }
            settings
        })
    }

    proptest! {
        #[test]
        fn an_address_gives_the_settings_back(settings in settings()) {
            let mut back = start();
            for (name, text) in settings.changed_parameters(&start()) {
                back.set_parameter(name, &text).unwrap();
            }
            for parameter in PARAMETERS {
                prop_assert_eq!((parameter.get)(&back), (parameter.get)(&settings));
            }
        }

        #[test]
        fn no_text_breaks_it(name in 0..PARAMETERS.len(), text in ".{0,12}") {
            let mut settings = start();
            let _ = settings.set_parameter(PARAMETERS[name].name, &text);
        }
    }

    #[test]
    fn a_typo_is_told() {
        let mut settings = start();
        let said = settings
            .set_parameter("raduis", "3")
            .unwrap_err()
            .to_string();
        assert!(
            said.contains("no setting 'raduis'") && said.contains("radius"),
            "{said}"
        );
        let said = settings.set_parameter("motion", "fell").unwrap_err();
        assert_eq!(
            said.to_string(),
            "motion is 'fell', but must be rest, fall, orbit, or a velocity BR,BT in units of c, such as -0.5,0.3"
        );
        assert_eq!(settings, start());
    }

    #[test]
    fn only_what_changed_is_in_an_address() {
        assert_eq!(start().changed_parameters(&start()), []);
        let mut settings = start();
        settings.view.radius = 4.0;
        settings.deflection = false;
        let changed = settings.changed_parameters(&start());
        assert_eq!(
            changed,
            [("radius", "4".to_owned()), ("method", "flat".to_owned())]
        );
    }
}
