//! Fields of comma-separated values.

use super::Time;
use lensbake_tables::statistics::ErrorStatistics;

/// A text as one field: in quotes where it has to be.
pub fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Three fields: the largest error, the 99.9th percentile, the RMS.
pub fn statistics(errors: &ErrorStatistics) -> String {
    let ErrorStatistics { max, p999, rms } = errors;
    format!("{max:.3e},{p999:.3e},{rms:.3e}")
}

/// Two fields: the time in ns and its relative spread.
pub fn time(time: Time) -> String {
    format!("{:.4},{:.4}", time.ns, time.spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_and_quotes_are_quoted() {
        assert_eq!(quoted("plain"), "plain");
        assert_eq!(quoted("a, b"), "\"a, b\"");
        assert_eq!(quoted("say \"a\""), "\"say \"\"a\"\"\"");
    }
}
