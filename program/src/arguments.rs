//! Parses the command line of a program.

use clap::error::Error;
use clap::{ArgMatches, CommandFactory, Parser};
use std::ffi::OsString;

/// Parses the arguments. Help and the version are printed at once and end the program.
///
/// # Errors
/// One line that names the option and says what is wrong with it, with the values that are possible and a hint at a typo.
pub fn read<Arguments: Parser>() -> Result<Arguments, String> {
    of(&matches::<Arguments>(std::env::args_os())?)
}

/// As [`read`], but parses these `arguments`, the first of which is the program's name, and returns clap's matches, which
/// tell options that were given from defaults. [`of`] makes them the arguments.
///
/// # Errors
/// As [`read`].
pub fn matches<Arguments: CommandFactory>(
    arguments: impl IntoIterator<Item = OsString>,
) -> Result<ArgMatches, String> {
    let command = Arguments::command();
    command.try_get_matches_from(arguments).map_err(line)
}

/// The arguments of these matches.
///
/// # Errors
/// As [`read`].
pub fn of<Arguments: Parser>(matches: &ArgMatches) -> Result<Arguments, String> {
    Arguments::from_arg_matches(matches).map_err(line)
}

/// The line of an error. Help and the version are no errors: they end the program.
fn line(error: Error) -> String {
    if !error.use_stderr() {
        error.exit();
    }
    in_one_line(&error.to_string())
}

/// The message of clap, which has several lines, without its usage.
fn in_one_line(message: &str) -> String {
    let lines = message.lines().map(str::trim);
    let lines = lines.filter(|line| !line.is_empty());
    let parts: Vec<_> = lines
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .collect();
    parts.join(" ").trim_start_matches("error: ").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Arguments {
        #[arg(long, value_parser = ["red", "green"])]
        colour: String,
    }

    #[test]
    fn every_mistake_gives_one_line() {
        for (arguments, wanted) in [
            (
                &["", "--colour", "gren"][..],
                "similar value exists: 'green'",
            ),
            (
                &["", "--color", "red"],
                "similar argument exists: '--colour'",
            ),
            (&[""], "--colour <COLOUR>"),
            (
                &["", "--colour", "red", "more"],
                "unexpected argument 'more'",
            ),
        ] {
            let line = in_one_line(
                &Arguments::try_parse_from(arguments)
                    .unwrap_err()
                    .to_string(),
            );
            assert!(line.contains(wanted) && line.lines().count() == 1, "{line}");
            assert!(
                !line.contains("error:") && !line.contains("Usage"),
                "{line}"
            );
        }
    }
}
