//! Parses the command line of a program.

use clap::Parser;

/// Parses the arguments. Help and the version are printed at once and end the program.
///
/// # Errors
/// One line that names the option and says what is wrong with it, with the values that are possible and a hint at a typo.
pub fn read<Arguments: Parser>() -> Result<Arguments, String> {
    Arguments::try_parse().map_err(|error| {
        if !error.use_stderr() {
            error.exit();
        }
        in_one_line(&error.to_string())
    })
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
