//! The chart's data as CSV: a line per method and observer, and one over all observers.

use super::rays::OBSERVERS;
use super::{CrossingChart, CrossingErrors, MeasuredCrossing};
use crate::figure::csv::{quoted, statistics, time};

const HEAD: &str = "observer,kind,method,source,bits,bytes,ns_per_crossing,ns_spread,\
                    max_relative,p999_relative,rms_relative,max_px,p999_px,rms_px";

/// The chart as CSV text with a header line. The method `inputs rounded to f32` is what rounding does that no method can
/// undo.
pub fn text(chart: &CrossingChart) -> String {
    let lines = chart.entries.iter().flat_map(lines);
    let rounding = format!(
        "all,rounding,inputs rounded to f32,,32,0,,,{}",
        errors(&chart.rounding)
    );
    std::iter::once(HEAD.to_owned())
        .chain(lines)
        .chain([rounding])
        .map(|line| line + "\n")
        .collect()
}

fn lines(entry: &MeasuredCrossing) -> Vec<String> {
    let observers = OBSERVERS.iter().map(f64::to_string);
    let sets =
        std::iter::once(("all".to_owned(), &entry.errors)).chain(observers.zip(&entry.by_observer));
    sets.map(|(observer, set)| {
        format!(
            "{observer},{},{},{},{},{},{},{}",
            entry.info.kind.name(),
            quoted(&entry.label),
            quoted(entry.info.source),
            entry.bits,
            entry.bytes,
            time(entry.time),
            errors(set),
        )
    })
    .collect()
}

fn errors(errors: &CrossingErrors) -> String {
    format!(
        "{},{}",
        statistics(&errors.relative),
        statistics(&errors.pixels)
    )
}
