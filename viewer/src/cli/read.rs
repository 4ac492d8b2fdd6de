//! Reads the command line.

use super::like::{Inherited, LikeError};
use super::{Cli, Command, RecordedOptions};
use clap::ArgMatches;
use lensbake_program::arguments;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The command whose options a picture records.
pub const RENDER: &str = "render";

/// Reads the command line. The options of the picture that `render --like` names are inserted before those that are
/// given, so that both are parsed alike.
///
/// # Errors
/// One line that names the option or the picture and says what is wrong.
pub fn read() -> Result<Cli, String> {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    let mut matches = arguments::matches::<Cli>(arguments.clone())?;
    if let Some(given) = matches.subcommand_matches(RENDER)
        && let Some(like) = given.get_one::<PathBuf>("like")
    {
        let merged = with_options_of(like, given, arguments);
        matches = merged.map_err(|error| error.to_string())?;
    }
    let mut cli: Cli = arguments::of(&matches)?;
    let recorded = matches
        .subcommand()
        .and_then(|(_, given)| RecordedOptions::of(given));
    match &mut cli.command {
        Some(Command::Render(args)) => args.recorded = recorded,
        Some(Command::Film(args)) => args.recorded = recorded,
        _ => {}
    }
    Ok(cli)
}

/// The matches of `arguments`, with `given` for the options of the command, and where these do not set them, of the options
/// that the picture `like` records.
fn with_options_of(
    like: &Path,
    given: &ArgMatches,
    mut arguments: Vec<OsString>,
) -> Result<ArgMatches, LikeError> {
    let inherited = Inherited::read(like)?.beside(given)?;
    // The program, its command, then options.
    arguments.splice(2..2, inherited);
    arguments::matches::<Cli>(arguments).map_err(|line| LikeError::Options {
        file: like.to_owned(),
        line,
    })
}
