//! Parses the command line of a program.

use clap::Parser;
use clap::error::ErrorKind;

/// Parses the arguments. Help, and typos with their hints, are printed at once and end the program.
///
/// # Errors
/// One line that names the option whose value is wrong and says why.
pub fn read<Arguments: Parser>() -> Result<Arguments, String> {
    Arguments::try_parse().map_err(|error| {
        if error.kind() != ErrorKind::ValueValidation {
            error.exit();
        }
        let text = error.to_string();
        let line = text.lines().next().unwrap_or_default();
        line.trim_start_matches("error: ").to_owned()
    })
}
