//! The options of `viewer render` as an .exr records them, so that the picture can be drawn again.

use super::Cli;
use super::disc::options_of;
use super::read::RENDER;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command, CommandFactory};
use lensbake_render::camera::{Projection, View};
use lensbake_render::disc::Disc;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ffi::OsString;

/// The attribute of an .exr that holds the options, as JSON.
pub const ATTRIBUTE: &str = "lensbake.options";

/// Newest version of the record that this program reads, and the one that it writes. A new option needs no new version.
pub const VERSION: u32 = 1;

/// The version of this program.
pub const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Options that do not belong to a picture: where it goes, what it is like, and what is printed.
const NOT_RECORDED: [&str; 3] = ["output", "like", "explain"];

/// All options of a picture with their values as a user gives them, defaults too: those of a later version may differ.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordedOptions {
    version: u32,
    /// Version of the program that wrote the record.
    pub program: String,
    /// Values by the long name of the option, without dashes. A flag has none.
    pub options: BTreeMap<String, Vec<String>>,
}

/// What every version of the record says of itself.
#[derive(Debug, Deserialize)]
pub struct RecordVersion {
    /// Version of the record.
    pub version: u32,
    /// Version of the program that wrote it.
    #[serde(default)]
    pub program: String,
}

impl RecordedOptions {
    /// The options of `viewer render` among these matches, which may be those of another command that shares options with
    /// it; `None` if a value is not UTF-8. Defaults that conflict with an option that is given are left out.
    pub fn of(matches: &ArgMatches) -> Option<Self> {
        let command = render();
        let given = Given::new(&command, matches);
        let mut options = BTreeMap::new();
        for (name, option) in recordable(&command).filter(|(_, option)| has(matches, option)) {
            let is_given = given.sets(option);
            if !is_given && given.excludes(option) {
                continue;
            }
            let values = matches.get_raw(option.get_id().as_str());
            let values = values.into_iter().flatten();
            let values = values.filter(|_| takes_values(option));
            let values: Option<Vec<String>> = values
                .map(|value| value.to_str().map(str::to_owned))
                .collect();
            let values = values?;
            if is_given || !values.is_empty() {
                options.insert(name.to_owned(), values);
            }
        }
        Some(RecordedOptions {
            version: VERSION,
            program: PROGRAM.to_owned(),
            options,
        })
    }

    /// The same options, with the size and the field of view of `view`, whose defaults depend on the projection.
    pub fn with_frame(self, view: &View) -> Self {
        let has_fov = match view.projection {
            Projection::Equirectangular | Projection::CubeFace(_) => false,
            Projection::Perspective | Projection::Fisheye | Projection::Dome { .. } => true,
        };
        let fov = has_fov.then(|| ("fov", view.fov_deg.to_string()));
        let size = ("size", format!("{}x{}", view.width, view.height));
        self.with([size].into_iter().chain(fov))
    }

    /// The same options, with the place, motion and orientation of `view`, and this exposure in stops if there is one.
    pub fn with_camera(self, view: &View, exposure: Option<f32>) -> Self {
        let numbers = [
            ("radius", view.radius),
            ("heading", view.heading_deg),
            ("yaw", view.yaw_deg),
            ("pitch", view.pitch_deg),
            ("roll", view.roll_deg),
            ("orbit", view.orbit_deg),
            ("latitude", view.latitude_deg),
        ];
        let numbers = numbers.map(|(name, number)| (name, number.to_string()));
        let motion = ("motion", view.motion.to_string());
        let exposure = exposure.map(|stops| ("exposure", stops.to_string()));
        self.with(numbers.into_iter().chain([motion]).chain(exposure))
    }

    /// The same options, with all of this disc, whose defaults may differ in a later version.
    pub fn with_disc(self, disc: Option<&Disc>) -> Self {
        self.with(disc.into_iter().flat_map(options_of))
    }

    fn with(mut self, options: impl Iterator<Item = (&'static str, String)>) -> Self {
        let options = options.map(|(name, value)| (name.to_owned(), vec![value]));
        self.options.extend(options);
        self
    }

    /// The arguments for the recorded options that `matches` neither sets nor excludes.
    ///
    /// # Errors
    /// The name of an option that this program does not have.
    pub fn arguments(&self, matches: &ArgMatches) -> Result<Vec<OsString>, String> {
        let command = render();
        let given = Given::new(&command, matches);
        let mut arguments = Vec::new();
        for (name, values) in &self.options {
            let found = recordable(&command).find(|(known, _)| known == name);
            let (_, option) = found.ok_or_else(|| name.clone())?;
            if given.sets(option) || given.excludes(option) {
                continue;
            }
            if takes_values(option) {
                let one = |value| OsString::from(format!("--{name}={value}"));
                arguments.extend(values.iter().map(one));
            } else {
                arguments.push(format!("--{name}").into());
            }
        }
        Ok(arguments)
    }
}

/// The definition of `viewer render`.
fn render() -> Command {
    let found = Cli::command().find_subcommand(RENDER).cloned();
    found.expect("the program has this command")
}

/// The options that a picture records, with their long names.
fn recordable(command: &Command) -> impl Iterator<Item = (&str, &Arg)> {
    let named = command
        .get_arguments()
        .filter_map(|option| Some((option.get_long()?, option)));
    named.filter(|(name, _)| !NOT_RECORDED.contains(name))
}

/// Whether the command of these matches has this option, too.
fn has(matches: &ArgMatches, option: &Arg) -> bool {
    matches.try_contains_id(option.get_id().as_str()).is_ok()
}

fn takes_values(option: &Arg) -> bool {
    option.get_action().takes_values()
}

/// The options that are given, not defaults.
struct Given<'a> {
    command: &'a Command,
    options: Vec<&'a Arg>,
}

impl<'a> Given<'a> {
    fn new(command: &'a Command, matches: &ArgMatches) -> Self {
        let is_given = |option: &&Arg| {
            has(matches, option)
                && matches.value_source(option.get_id().as_str()) == Some(ValueSource::CommandLine)
        };
        Given {
            command,
            options: command.get_arguments().filter(is_given).collect(),
        }
    }

    fn sets(&self, option: &Arg) -> bool {
        self.options.contains(&option)
    }

    /// Whether an option that is given conflicts with `option`. Clap knows a conflict from one side only.
    fn excludes(&self, option: &Arg) -> bool {
        let names = |from: &Arg, to: &Arg| self.command.get_arg_conflicts_with(from).contains(&to);
        let mut given = self.options.iter();
        given.any(|given| names(given, option) || names(option, given))
    }
}
